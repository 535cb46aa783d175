#pragma once
// Pictures of the corridors as the walker's camera takes them: 8-bit grey, with the lens's
// distortion and vignetting and the sensor's noise. More than 20 frames of 640x480 a second on one
// core. The same place, seed and noise key give the same picture on any number of threads.
//
//   const CorridorRenderer renderer(walk.plan, walk.options.camera, walk.options.seed);
//   const cv::Mat image = renderer.render(walk.world_from_camera(stamp), frame);
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/camera.hpp"
#include "simulation/floor_plan.hpp"

namespace vpdr::simulation {

class Scene;
class PixelShader;
struct View;

struct RenderOptions {
  int threads = 1;
  double noise = 1.4;        ///< of the sensor in the dark, grey levels, standard deviation
  double vignetting = 0.16;  ///< loss of light in the corners, relative
};

/// render() may be called from several threads.
class CorridorRenderer {
 public:
  CorridorRenderer(const FloorPlan& plan, const Camera& camera, std::uint64_t seed,
                   const RenderOptions& options = {});
  ~CorridorRenderer();
  CorridorRenderer(const CorridorRenderer&) = delete;
  CorridorRenderer& operator=(const CorridorRenderer&) = delete;

  /// The picture from a pose, CV_8UC1. `noise_key` makes the noise of one picture differ from that
  /// of the next: pass the frame's number. Throws std::domain_error for an eye outside the
  /// corridors.
  [[nodiscard]] cv::Mat render(const Eigen::Isometry3d& world_from_camera,
                               std::uint64_t noise_key = 0) const;

  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }

 private:
  void render_rows(const View& view, std::uint64_t noise_key, int first, int last,
                   cv::Mat& image) const;
  void shade_row(const View& view, int row, std::vector<float>& brightness,
                 std::vector<int>& surface) const;
  [[nodiscard]] float smooth_edge(const View& view, int row, int column) const;
  void develop(int row, std::uint64_t noise_key, const std::vector<float>& brightness,
               std::uint8_t* pixels) const;

  Camera camera_;
  RenderOptions options_;
  std::uint64_t seed_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<PixelShader> shader_;
  std::vector<Eigen::Vector2f> rays_;  ///< undistorted normalised coordinates of each pixel
  std::vector<float> gain_;            ///< lens, of each pixel
  std::vector<float> noise_;           ///< normal numbers to draw from
};

}  // namespace vpdr::simulation
