#include "simulation/render/film.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

constexpr double kLampsOff = 0.02;       // of the light, from exit signs and windows
constexpr double kPixelsPerPart = 1.5;   // of motion between two instants of one exposure
constexpr double kNearM = 1.5;           // things that move with the walker's own speed at most
constexpr double kShortestSwingS = 2.0;  // of the exposure
constexpr double kLongestSwingS = 15.0;

void check(const FilmOptions& o) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw ConfigurationFault("simulate: " + what);
  };
  require(o.exposure_s >= 0.0 && o.exposure_s <= 0.5, "exposure_s must be 0 (no blur) to 0.5");
  require(o.exposure_parts >= 1 && o.exposure_parts <= 64, "exposure_parts must be 1 to 64");
  require(o.exposure_swing_ev >= 0.0 && o.exposure_swing_ev <= 3.0,
          "exposure_swing_ev must be 0 to 3");
  require(o.passers_by_per_min >= 0.0 && o.passers_by_per_min <= 60.0,
          "passers_by_per_min must be 0 to 60");
  const ImageSensorOptions& s = o.render.sensor;
  require(s.read_noise >= 0.0 && s.read_noise <= 50.0, "read_noise must be 0 to 50");
  require(s.shot_noise >= 0.0 && s.shot_noise <= 10.0, "shot_noise must be 0 to 10");
  require(s.vignetting >= 0.0 && s.vignetting <= 1.0, "vignetting must be 0 to 1");
  for (const auto* stretches : {&o.dark, &o.blank}) {
    for (const Stretch& stretch : *stretches) {
      require(stretch.to_s > stretch.from_s, "a stretch must end after it begins");
    }
  }
}

bool within(const std::vector<Stretch>& stretches, double t_s) {
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& s) { return t_s >= s.from_s && t_s < s.to_s; });
}

SmoothNoise draw_swing(std::uint64_t seed) {
  Random random(seed, "exposure");
  return {random, kShortestSwingS, kLongestSwingS};
}

const FilmOptions& checked(const FilmOptions& options) {
  check(options);
  return options;
}

}  // namespace

Film::Film(Shot shot, const FilmOptions& options)
    : shot_(std::move(shot)),
      options_(checked(options)),
      renderer_(shot_.plan, shot_.camera, shot_.seed, options.render, shot_.furniture),
      passers_by_(shot_, options.passers_by_per_min),
      swing_(draw_swing(shot_.seed)) {}

FrameTruth Film::truth(std::size_t frame) const {
  const Eigen::Isometry3d pose = shot_.world_from_camera(stamp(frame));
  return {stamp(frame), pose, building_directions(pose)};
}

cv::Mat Film::image(std::size_t frame) const {
  const TimestampNs at = stamp(frame);
  const double t_s = to_seconds(at - shot_.frames.front());
  double exposure = std::exp2(options_.exposure_swing_ev * swing_(t_s));
  if (within(options_.dark, t_s)) exposure *= kLampsOff;
  if (within(options_.blank, t_s)) {
    return renderer_.sensor().develop(blank_wall(), exposure, frame);
  }
  const int parts = parts_of_exposure(at);
  cv::Mat sum = light(at);
  if (parts > 1) {
    sum.setTo(0.0);
    for (int part = 0; part < parts; ++part) {
      const double share = (part + 0.5) / parts - 0.5;
      sum += light(at + to_ns(share * options_.exposure_s)) * (1.0 / parts);
    }
  }
  return renderer_.sensor().develop(sum, exposure, frame);
}

cv::Mat Film::light(TimestampNs stamp_ns) const {
  return renderer_.light(shot_.world_from_camera(stamp_ns), passers_by_.at(stamp_ns));
}

/// Paint a hand's breadth away: nothing but a slow fall of light towards one side.
cv::Mat Film::blank_wall() const {
  cv::Mat wall(shot_.camera.height, shot_.camera.width, CV_32FC1);
  for (int row = 0; row < wall.rows; ++row) {
    for (int column = 0; column < wall.cols; ++column) {
      const double aside = static_cast<double>(column) / wall.cols;
      wall.at<float>(row, column) = static_cast<float>(0.55 - 0.08 * aside);
    }
  }
  return wall;
}

/// Enough instants that the picture moves by little from one to the next.
int Film::parts_of_exposure(TimestampNs stamp_ns) const {
  if (!(options_.exposure_s > 0.0)) return 1;
  const TimestampNs half = to_ns(0.5 * options_.exposure_s);
  const Eigen::Isometry3d moved =
      shot_.world_from_camera(stamp_ns - half).inverse() * shot_.world_from_camera(stamp_ns + half);
  const double turned = Eigen::AngleAxisd(moved.linear()).angle();
  const double pixels = shot_.camera.fx * (turned + moved.translation().norm() / kNearM);
  return std::clamp(static_cast<int>(std::ceil(pixels / kPixelsPerPart)), 1,
                    options_.exposure_parts);
}

cv::Mat Film::depth(std::size_t frame) const {
  const TimestampNs at = stamp(frame);
  cv::Mat depth = renderer_.ranges(shot_.world_from_camera(at), passers_by_.at(at));
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      const double forward = shot_.camera.ray({column, row}).z();
      auto& value = depth.at<float>(row, column);
      value = static_cast<float>(std::max(0.0, forward * value));
    }
  }
  return depth;
}

}  // namespace vpdr::simulation
