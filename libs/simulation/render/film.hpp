#pragma once
// The pictures of a shot, made when they are asked for, with what real cameras and buildings do to
// them: motion blur, changing exposure, lamps that go out, a blank wall before the lens, people.
// All from the shot's seed: the same shot and options give the same pictures in every process.
#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/random.hpp"
#include "simulation/render/passers_by.hpp"
#include "simulation/render/scene_renderer.hpp"
#include "simulation/render/shot.hpp"

namespace vpdr::simulation {

/// A stretch of time, seconds from the first picture: from <= t < to.
struct Stretch {
  double from_s = 0.0;
  double to_s = 0.0;
};

struct FilmOptions {
  RenderOptions render;
  double exposure_s = 0.0;          ///< shutter time: what moves meanwhile is blurred; 0: none
  int exposure_parts = 8;           ///< at most this many instants make a blurred picture
  double exposure_swing_ev = 0.0;   ///< slow changes of brightness, stops, standard deviation
  double passers_by_per_min = 0.0;  ///< people met
  std::vector<Stretch> dark{};      ///< the lamps are off
  std::vector<Stretch> blank{};     ///< a plain wall fills the view
};

/// What is exactly true of one picture.
struct FrameTruth {
  TimestampNs stamp_ns = 0;
  Eigen::Isometry3d world_from_camera = Eigen::Isometry3d::Identity();
  /// Where the walls' directions (world x, y, z) point, camera axes: they project to the vanishing
  /// points.
  std::array<Eigen::Vector3d, 3> building{};
};

/// image(), depth() and truth() may be called from several threads; they throw std::out_of_range.
class Film {
 public:
  /// Throws ConfigurationFault naming the option that makes no sense.
  explicit Film(Shot shot, const FilmOptions& options = {});

  [[nodiscard]] const Shot& shot() const { return shot_; }
  [[nodiscard]] std::size_t count() const { return shot_.frames.size(); }
  [[nodiscard]] TimestampNs stamp(std::size_t frame) const { return shot_.frames.at(frame); }
  /// Picture number `frame`, CV_8UC1; always the same one.
  [[nodiscard]] cv::Mat image(std::size_t frame) const;
  /// Depth along the optical axis, metres, CV_32FC1; 0 where a fisheye looks sideways or behind.
  [[nodiscard]] cv::Mat depth(std::size_t frame) const;
  [[nodiscard]] FrameTruth truth(std::size_t frame) const;

 private:
  [[nodiscard]] cv::Mat light(TimestampNs stamp_ns) const;
  [[nodiscard]] cv::Mat blank_wall() const;
  [[nodiscard]] int parts_of_exposure(TimestampNs stamp_ns) const;

  Shot shot_;
  FilmOptions options_;
  SceneRenderer renderer_;
  PassersBy passers_by_;
  SmoothNoise swing_;
};

}  // namespace vpdr::simulation
