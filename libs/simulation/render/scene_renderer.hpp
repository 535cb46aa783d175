#pragma once
// The inside of a building as a camera sees it, through whatever lens: light, and the exact
// distance to what is seen. More than 20 frames of 640x480 a second on one core. The same place and
// seed give the same picture on any number of threads.
//
//   const SceneRenderer renderer(walk.plan, walk.options.camera, walk.options.seed);
//   const cv::Mat image = renderer.render(walk.world_from_camera(stamp), frame);
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/camera.hpp"
#include "simulation/floor_plan.hpp"
#include "simulation/render/image_sensor.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

class Scene;
class PixelShader;
class RayTable;

struct RenderOptions {
  int threads = 1;
  ImageSensorOptions sensor;
};

/// All functions may be called from several threads. They throw std::domain_error for an eye
/// outside free space.
class SceneRenderer {
 public:
  SceneRenderer(const FloorPlan& plan, const Camera& camera, std::uint64_t seed,
                const RenderOptions& options = {}, std::vector<Solid> furniture = {});
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /// The picture from a pose, CV_8UC1. `noise_key` makes the noise of one picture differ from that
  /// of the next: pass the frame's number.
  [[nodiscard]] cv::Mat render(const Eigen::Isometry3d& world_from_camera,
                               std::uint64_t noise_key = 0) const;
  /// Light that falls on each pixel, CV_32FC1, 0 black to 1 white, with more solids than the
  /// furniture.
  [[nodiscard]] cv::Mat light(const Eigen::Isometry3d& world_from_camera,
                              const std::vector<Solid>& others = {}) const;
  /// How far each pixel's middle sees, metres along its ray, CV_32FC1.
  [[nodiscard]] cv::Mat ranges(const Eigen::Isometry3d& world_from_camera,
                               const std::vector<Solid>& others = {}) const;

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const ImageSensor& sensor() const { return sensor_; }

 private:
  struct Frame;
  struct Row;

  [[nodiscard]] Frame frame_of(const Eigen::Isometry3d& world_from_camera,
                               const std::vector<Solid>& others) const;
  void find_candidates(const Eigen::Isometry3d& world_from_camera,
                       const std::vector<const Solid*>& solids, Frame& frame) const;
  template <class Work>
  void in_bands(const Work& work) const;
  void light_rows(const Frame& frame, int first, int last, cv::Mat& light) const;
  void shade_row(const Frame& frame, int row, Row& out) const;
  [[nodiscard]] float smooth_edge(const Frame& frame, const Row& row, int number,
                                  std::size_t column) const;

  Camera camera_;
  int threads_;
  ImageSensor sensor_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<PixelShader> shader_;
  std::unique_ptr<RayTable> rays_;
};

/// The three directions of a building whose walls run along the world's axes, camera axes: the true
/// vanishing points are where they project (and their opposites).
std::array<Eigen::Vector3d, 3> building_directions(const Eigen::Isometry3d& world_from_camera);

}  // namespace vpdr::simulation
