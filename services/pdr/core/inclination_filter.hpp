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
  double time_constant_s = 1.5;  ///< s, of each of the low-pass's two stages; (0.05, 60)
  double time_constant_without_gyro_s = 0.25;  ///< s, the same for a board without gyroscope
  double base_sigma_rad = 0.01;                ///< rad, accelerometer offset and mounting; (0, 1)
};

class InclinationFilter {
 public:
  explicit InclinationFilter(const InclinationConfig& config);

  /// Adds the mean specific force of the last `dt_s` seconds in world axes and gives the rotation
  /// (world axes) that brings the low-passed force upright. Apply it to the attitude with turn().
  Eigen::Quaterniond correct(const Eigen::Vector3d& force_world_mps2, double dt_s, bool has_gyro);

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

 private:
  InclinationConfig config_;
  Eigen::Vector3d fast_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_ = Eigen::Vector3d::Zero();
  double horizontal_variance_ = 0.0;  ///< (m/s^2)^2 of the force about its low-pass
  double age_s_ = 0.0;                ///< since the start or the last gap
  double start_variance_ = 0.0;       ///< rad^2, what a gap has added and time takes away
};

}  // namespace vpdr::pdr
