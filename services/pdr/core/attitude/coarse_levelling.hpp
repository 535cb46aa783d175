#pragma once
// The horizon at the start and after a gap: the mean specific force of a short while is upright.
// How far it may be off is told by the force's own spread: the mean of a person who stands is good
// to a degree, that of one who sets off, or gestures, is not. SI, rad. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::pdr {

class CoarseLevelling {
 public:
  /// Adds what specific force summed up to over the last `duration_s`, axes of the present
  /// estimate of the world; m/s, s. Returns the turn that brings its mean upright, with which the
  /// caller must turn the estimate.
  Eigen::Quaterniond add(const Eigen::Vector3d& velocity_mps, double duration_s);
  /// Of each tilt, rad: spread of the force over gravity.
  [[nodiscard]] double tilt_sigma_rad() const;
  [[nodiscard]] double duration_s() const { return duration_s_; }
  void restart() { *this = CoarseLevelling{}; }

 private:
  double duration_s_ = 0.0;
  Eigen::Vector3d sum_mps_ = Eigen::Vector3d::Zero();
  double square_sum_ = 0.0;  ///< of the force, m^2/s^3
};

}  // namespace vpdr::pdr
