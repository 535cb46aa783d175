#pragma once
// Attitude that no magnetometer ever touches: level as the accelerometer says, turned about the
// vertical by the gyroscope alone, yaw 0 at the start. It is smooth and good over minutes, which is
// what a walk's shape needs; where it points in the world is DeadReckoning's to find out.
//
// What the attitude filter learns of the bias later on is applied from then on and never turns the
// past: the caller is told instead how the bias changed, so that it can correct the whole walk.
// Frame "odom": z up, yaw arbitrary. SI, rad. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "core/samples.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "pdr/core/attitude/rest_detector.hpp"

namespace vpdr::pdr {

/// What the heading of a RelativeAttitude went through since it was asked last. What is left of the
/// gyroscope's bias, b in body axes, makes the true yaw run away from the relative one by -b . up.
struct RelativeMotion {
  double elapsed_s = 0.0;
  double turned_rad = 0.0;  ///< about any axis
  double gap_s = 0.0;       ///< of the elapsed time, without a sample
  double blind_rad2 = 0.0;  ///< variance added by silences and samples without gyroscope
  Eigen::Vector3d up_s = Eigen::Vector3d::Zero();  ///< integral of the vertical, body axes
  Eigen::Vector3d bias_change_radps = Eigen::Vector3d::Zero();  ///< newly taken off, body axes
  std::optional<Eigen::Vector3d> rest_bias_radps;  ///< b before that change: measured at rest
};

class RelativeAttitude {
 public:
  explicit RelativeAttitude(AttitudeConfig config);

  void process(const ImuSample& sample);
  /// As AttitudeFilter's.
  void expect_velocity(const Eigen::Vector3d& body_mps) { filter_.expect_velocity(body_mps); }
  /// Everything since the last call.
  RelativeMotion take_motion();

  [[nodiscard]] const Eigen::Quaterniond& odom_from_body() const { return odom_from_body_; }
  /// Bias removed, body axes, rad/s.
  [[nodiscard]] const Eigen::Vector3d& rate_radps() const { return rate_; }
  /// Variance of each of the two tilts, rad^2.
  [[nodiscard]] double tilt_variance_rad2() const;
  [[nodiscard]] bool at_rest() const { return rest_.at_rest(); }

 private:
  void note_passed(const ImuSample& sample);
  void note_rest();

  AttitudeConfig config_;
  AttitudeFilter filter_;
  RestDetector rest_;
  Eigen::Quaterniond odom_from_body_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  double turned_by_filter_ = 0.0;
  std::optional<TimestampNs> last_stamp_;
  RelativeMotion motion_;
};

}  // namespace vpdr::pdr
