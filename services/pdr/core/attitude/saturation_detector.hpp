#pragma once
// Tells when a sensor reads its limit: an axis that gives the very same large value several times
// in a row. What the reading hides beyond the limit is unknown. Body axes, any unit.
// Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cmath>

namespace vpdr::pdr {

class SaturationDetector {
 public:
  /// Values below `least` are never a limit.
  explicit SaturationDetector(double least) : least_(least) {}

  /// True while any axis of the readings so far is at its limit.
  bool add(const Eigen::Vector3d& reading) {
    const bool repeats = (reading.array() == last_.array()).any();
    const bool saturated = (repeats || repeating_) && follow(reading);
    repeating_ = repeats;
    last_ = reading;
    return saturated;
  }

 private:
  static constexpr int kRun = 3;  ///< equal values in a row that noise does not give

  bool follow(const Eigen::Vector3d& reading) {
    bool saturated = false;
    for (int axis = 0; axis < 3; ++axis) {
      const bool stuck = reading[axis] == last_[axis] && std::abs(reading[axis]) > least_;
      int& run = runs_[static_cast<std::size_t>(axis)];
      run = stuck ? run + 1 : 0;
      saturated = saturated || run + 1 >= kRun;
    }
    return saturated;
  }

  double least_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  std::array<int, 3> runs_{};
  bool repeating_ = false;  ///< some axis does, which is rare
};

}  // namespace vpdr::pdr
