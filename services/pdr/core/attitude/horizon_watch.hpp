#pragma once
// Tells when the horizon is lost: a reading that was none, or a turn that the gyroscope did not
// see, may tilt it by any angle, and a filter that is sure of it would take what gravity then does
// for a person's speeding up. But nobody gains or loses so much speed within seconds. World axes,
// SI. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <algorithm>

namespace vpdr::pdr {

class HorizonWatch {
 public:
  /// Adds what specific force summed up to over the last `duration_s`, m/s. True when no person's
  /// speed changes like that.
  bool add(const Eigen::Vector3d& velocity_mps, double duration_s) {
    const double kept = std::max(0.0, 1.0 - duration_s / kMemory_s);
    gained_mps_ = kept * gained_mps_ + velocity_mps;
    return gained_mps_.head<2>().squaredNorm() > kLargestChange_mps * kLargestChange_mps;
  }
  /// Turns the memory with the world frame.
  void turn(const Eigen::Matrix3d& world_from_old_world) {
    gained_mps_ = (world_from_old_world * gained_mps_).eval();
  }
  void restart() { gained_mps_.setZero(); }

 private:
  static constexpr double kMemory_s = 6.0;
  static constexpr double kLargestChange_mps = 8.0;

  Eigen::Vector3d gained_mps_ = Eigen::Vector3d::Zero();  ///< of the recent past, gravity's with it
};

}  // namespace vpdr::pdr
