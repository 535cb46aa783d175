#pragma once
// Does the camera stand still? Its points stay where they are for a while and the gyroscope does
// not contradict. The frame compared with stays the same meanwhile, so that creeping shows.
// Pixels, radians, seconds. Not thread-safe; allocates nothing once its buffers have grown.
#include <optional>
#include <vector>

#include "vision/core/attitude_track.hpp"
#include "vision/core/odometry/feature_tracks.hpp"

namespace vpdr::vision {

struct StillnessConfig {
  double still_px = 0.6;         ///< points of a still camera stay within, median
  double still_s = 0.25;         ///< so long before stillness is believed
  double still_turn_rad = 0.02;  ///< a gyroscope that saw more contradicts it
};

class StillnessWatch {
 public:
  /// `gyro_bias_sigma_radps`: what the gyroscope may report of a body at rest.
  StillnessWatch(const StillnessConfig& config, double gyro_bias_sigma_radps)
      : config_(config), gyro_bias_sigma_radps_(gyro_bias_sigma_radps) {}

  /// True while the camera stands still. Frames in the order of their stamps.
  bool stands_still(const FeatureTracks& frame, const std::optional<AttitudePrior>& attitude);
  /// Forgets what was seen: the next frame begins anew.
  void restart() { reference_.features.clear(); }

 private:
  StillnessConfig config_;
  double gyro_bias_sigma_radps_;
  FeatureTracks reference_;
  std::optional<AttitudePrior> reference_attitude_;
  std::vector<double> values_;
};

}  // namespace vpdr::vision
