#pragma once
// By how much more than configured a magnetometer's readings are older than their stamps, against
// those of the gyroscope. Learned while the body turns: a reading that an attitude too young turns
// into the world is off across the axis of the turn, by rate times delay. What a reading differs
// by from the usual field (its misfit) is laid against that direction; turns come and go in both
// senses, and other errors do not follow them. Seconds, microtesla. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct MagneticDelayConfig {
  double sigma_s = 0.02;          ///< s, how far it may be from what is configured; (0, 0.1)
  double correlation_s = 0.1;     ///< s, over which a misfit as quick as turns is alike; (0.01, 60)
  double largest_s = 0.06;        ///< s, held within; (0, 0.2)
  double least_sigma_s = 0.0015;  ///< s, of any sensor's delay, however well they agree; (0, 0.1)
};

class MagneticDelay {
 public:
  explicit MagneticDelay(const MagneticDelayConfig& config);

  /// A misfit that stands for the last `dt_s` seconds, its variance in each direction, and how the
  /// turned field changes with the delay that it was turned back by.
  void add(const Eigen::Vector3d& misfit_ut, double variance_ut2, const Eigen::Vector3d& slope_utps,
           double dt_s);

  /// On top of what is configured.
  [[nodiscard]] double excess_s() const { return excess_s_; }
  [[nodiscard]] double variance_s2() const { return variance_s2_; }
  /// Variance of the inertial sensors' delay, which nothing on board tells: `unknown_s2` as long as
  /// no delay is known; a device that stamps one sensor late stamps the others late by as much.
  [[nodiscard]] double inertial_variance_s2(double unknown_s2) const;

 private:
  MagneticDelayConfig config_;
  double excess_s_ = 0.0;
  double variance_s2_;
};

}  // namespace vpdr::pdr
