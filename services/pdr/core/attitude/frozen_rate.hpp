#pragma once
// Tells which axes of a gyroscope are stuck: they repeat a turn to the last bit, which noise does
// not let happen. What repeats below is taken for a bias at rest, what repeats above for the
// sensor's limit (SaturationDetector). Body axes, SI. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vpdr::pdr {

class FrozenRate {
 public:
  void add(const Eigen::Vector3d& rate_radps, double dt_s) {
    const bool repeats = (rate_radps.array() == last_radps_.array()).any();
    if (repeats || repeating_) follow(rate_radps, dt_s);
    repeating_ = repeats;
    last_radps_ = rate_radps;
  }
  /// 0 for an axis that is stuck, 1 for one that is not.
  [[nodiscard]] Eigen::Vector3d alive() const {
    if (!repeating_) return Eigen::Vector3d::Ones();
    return {alive(runs_[0]), alive(runs_[1]), alive(runs_[2])};
  }
  /// For how long the one that is stuck longest has been, s; 0: none is.
  [[nodiscard]] double frozen_s() const {
    double longest_s = 0.0;
    if (!repeating_) return longest_s;
    for (const Run& run : runs_) {
      if (alive(run) == 0.0) longest_s = std::max(longest_s, run.time_s);
    }
    return longest_s;
  }

 private:
  struct Run {
    int samples = 0;
    double time_s = 0.0;
  };
  static constexpr double kLeast_radps = 0.1;
  static constexpr double kMost_radps = 4.0;
  static constexpr int kSamples = 4;
  static constexpr double kTime_s = 0.1;

  void follow(const Eigen::Vector3d& rate_radps, double dt_s) {
    for (int axis = 0; axis < 3; ++axis) {
      Run& run = runs_[static_cast<std::size_t>(axis)];
      const double size = std::abs(rate_radps[axis]);
      const bool repeats =
          rate_radps[axis] == last_radps_[axis] && size > kLeast_radps && size < kMost_radps;
      run = repeats ? Run{run.samples + 1, run.time_s + dt_s} : Run{};
    }
  }
  static double alive(const Run& run) {
    return run.samples >= kSamples && run.time_s >= kTime_s ? 0.0 : 1.0;
  }

  Eigen::Vector3d last_radps_ = Eigen::Vector3d::Zero();
  std::array<Run, 3> runs_{};
  bool repeating_ = false;  ///< some axis does, which is rare
};

}  // namespace vpdr::pdr
