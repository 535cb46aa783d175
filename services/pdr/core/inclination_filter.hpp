#pragma once
// The accelerometer's share of the complementary filter (S3.3: 1, 2). Specific force is turned into
// the world by the gyroscope-integrated attitude and low-passed there: in that almost inertial
// frame gravity stands still while steps and gestures average out, so that walking does not tilt
// the horizon. Turning the low-passed force onto the vertical replaces the slow part of the
// gyroscope's inclination by the accelerometer's: G_1 is this low-pass, and what stays of the
// gyroscope is G_2 = 1 - G_1 by construction. It turns about horizontal axes only, so heading is
// never touched. World axes (z up), SI. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::pdr {

struct InclinationConfig {
  double shortest_time_constant_s = 1.0;  ///< s, of each of the low-pass's two stages; (0.05, 60)
  double longest_time_constant_s = 4.0;   ///< s, the same; (0.05, 60)
  double time_constant_without_gyro_s = 0.25;  ///< s, for a board without gyroscope; (0.05, 60)
  double drift_rad_sqrt_s = 0.04;  ///< rad per sqrt(s), drift of the integrated rate; (1e-4, 1)
  double turning_error = 0.02;     ///< share of the rate by which turning adds to it; (0, 1)
  double base_sigma_rad = 0.01;    ///< rad, accelerometer offset and mounting; (0, 1)
};

class InclinationFilter {
 public:
  explicit InclinationFilter(const InclinationConfig& config);

  /// Adds the mean specific force of the last `dt_s` seconds in world axes, during which the body
  /// turned at `rate_radps` (any axis), and gives the rotation (world axes) that brings the
  /// low-passed force upright. The attitude takes it, and turn() the memory.
  Eigen::Quaterniond correct(const Eigen::Vector3d& force_world_mps2, double rate_radps,
                             double dt_s);
  /// The same for a board without gyroscope.
  Eigen::Quaterniond correct_without_gyro(const Eigen::Vector3d& force_world_mps2, double dt_s);

  /// Turns the memory with the world frame: call with every correction that the attitude takes.
  void turn(const Eigen::Quaterniond& world_from_old_world);

  /// The next forces count as the first ones: after a gap.
  void restart(double sigma_rad);

  /// Low-passed specific force, world axes.
  [[nodiscard]] const Eigen::Vector3d& upward_mps2() const { return slow_; }
  /// Variance of roll and pitch, rad^2.
  [[nodiscard]] double variance_rad2() const;
  /// False while the low-pass still averages its first samples.
  [[nodiscard]] bool settled() const;
  /// Time constant of each stage that suits the present movement, s.
  [[nodiscard]] double time_constant_s() const;

 private:
  Eigen::Quaterniond low_pass(const Eigen::Vector3d& force_world_mps2, double time_constant_s,
                              double dt_s);

  InclinationConfig config_;
  Eigen::Vector3d fast_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_ = Eigen::Vector3d::Zero();
  double horizontal_variance_ = 0.0;  ///< (m/s^2)^2 of the force about its low-pass
  double rate_variance_ = 0.0;        ///< (rad/s)^2, mean square of the rate
  double age_s_ = 0.0;                ///< since the start or the last gap
  double start_variance_ = 0.0;       ///< rad^2, what a gap has added and time takes away
};

}  // namespace vpdr::pdr
