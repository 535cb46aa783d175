#pragma once
// The complementary filter of the AHRS paper as printed (S3.3), kept as a baseline to compare with:
//   (1) C = C_0 G_1 + C_w G_2   (2) G_1 + G_2 = 1, so that C is the truth where both halves are
// C_0 is the attitude that accelerometer and magnetometer give at this instant, through the
// low-pass G_1(s) = k / (s + k); C_w is the integrated gyroscope, through the high-pass
// G_2(s) = s / (s + k). Both at once are one rate, W = w + k e, with e the rotation (body axes)
// from the estimate to C_0, integrated by a first-order Runge-Kutta step of q' = q (0, W) / 2.
// No bias, no disturbance detection, no covariance of its own: it reports what the paper promises.
//
// Body forward-left-up, world ENU, SI, radians. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::pdr {

struct ComplementaryConfig {
  double time_constant_s = 2.0;      ///< s, 1 / k: where gyroscope and C_0 cross over; (0.01, 600)
  double level_sigma_rad = 0.0105;   ///< rad, roll and pitch: 0.6 deg (S3.6); (0, 3)
  double heading_sigma_rad = 0.021;  ///< rad, yaw: 1.2 deg (S3.6); (0, 3)
};

class ComplementaryFilter {
 public:
  explicit ComplementaryFilter(const ComplementaryConfig& config) : config_(config) {}

  void start(const Eigen::Quaterniond& world_from_body) { world_from_body_ = world_from_body; }
  /// One step of `dt_s` seconds on from the instant at which the rate (body axes) and C_0 were
  /// measured.
  void step(const Eigen::Vector3d& rate_radps, const Eigen::Quaterniond& measured, double dt_s);

  [[nodiscard]] const Eigen::Quaterniond& world_from_body() const { return world_from_body_; }
  /// What the paper promises, world axes, rad^2.
  [[nodiscard]] Eigen::Matrix3d covariance_rad2() const;

 private:
  ComplementaryConfig config_;
  Eigen::Quaterniond world_from_body_ = Eigen::Quaterniond::Identity();
};

/// First-order Runge-Kutta step of q' = q (0, w) / 2 over the angle w dt (body axes, rad).
Eigen::Quaterniond first_order_step(const Eigen::Quaterniond& q, const Eigen::Vector3d& angle_rad);

}  // namespace vpdr::pdr
