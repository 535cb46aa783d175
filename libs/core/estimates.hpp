#pragma once
// What the services estimate, each with its uncertainty. World ENU, body forward-left-up.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "core/time.hpp"

namespace vpdr {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Attitude of the body, one for each inertial sample.
struct AttitudeEstimate {
  TimestampNs stamp_ns = 0;
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance_rad2 =
      Eigen::Matrix3d::Zero();  ///< of the rotation vector, world axes
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();  ///< body axes, bias removed
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();     ///< body axes, as measured
  bool yaw_is_absolute = false;  ///< false: no usable magnetometer yet, yaw 0 is not east
  Eigen::Vector3d gyro_bias_radps = Eigen::Vector3d::Zero();  ///< body axes
  bool at_rest = false;
  bool magnetically_disturbed = false;  ///< the field is not used at present
};

/// How sure it is that a step is one.
enum class StepStatus : std::uint8_t {
  kTentative = 0,  ///< may still be withdrawn
  kConfirmed = 1,  ///< final
  kWithdrawn = 2,  ///< final: the tentative step of the same stamp was none
};

/// One step of the walker, at the instant of its acceleration peak.
struct StepEvent {
  TimestampNs stamp_ns = 0;
  std::uint32_t index = 0;  ///< 1 for the first; of a tentative step, should it be confirmed
  double length_m = 0.0;
  double length_sigma_m = 0.0;
  double frequency_hz = 0.0;
  double yaw_rad = 0.0;  ///< walking direction in the world
  double yaw_sigma_rad = 0.0;
  double yaw_revision_rad = 0.0;  ///< as in HeadingEstimate
  /// The stamp is a step's identity: exactly one confirmation or withdrawal follows a tentative
  /// one.
  StepStatus status = StepStatus::kConfirmed;
  double probability = 1.0;  ///< that it is a step
};

/// Walking direction.
struct HeadingEstimate {
  TimestampNs stamp_ns = 0;
  double yaw_rad = 0.0;
  double yaw_sigma_rad = 0.0;
  bool yaw_is_absolute = false;
  /// Part of yaw_sigma_rad that is alike for the whole walk and that later headings may revise: of
  /// the direction of the gyroscope's zero yaw. 0 where the source does not tell.
  double yaw_zero_sigma_rad = 0.0;
  /// Sum of the revisions of that zero: a heading given before was off by what was added since.
  double yaw_revision_rad = 0.0;
};

/// A position with its attitude. Covariance order: x y z, rotation about world x y z.
struct PoseEstimate {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Matrix6d covariance = Matrix6d::Zero();
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();  ///< body axes
  double speed_mps = 0.0;  ///< along the walking direction
};

/// What the camera says of its direction relative to the corridor, one for each frame.
struct CorridorHeading {
  TimestampNs stamp_ns = 0;
  bool found = false;         ///< false: no corridor in view; the numbers below mean nothing
  double heading_rad = 0.0;   ///< of the camera, counter-clockwise from the corridor's direction
  double pitch_rad = 0.0;     ///< of the camera, positive looking up
  double sigma_rad = 0.0;     ///< of the heading
  std::uint32_t inliers = 0;  ///< line segments along the corridor or across it
};

/// Turn rate of the camera between two frames.
struct HeadingRate {
  TimestampNs stamp_ns = 0;           ///< of the later frame
  TimestampNs interval_start_ns = 0;  ///< of the earlier frame
  double rate_radps = 0.0;            ///< counter-clockwise seen from above
  double sigma_radps = 0.0;
};

/// Motion of the body between two frames, in the axes of the earlier one.
struct MotionEstimate {
  TimestampNs stamp_ns = 0;           ///< of the later frame
  TimestampNs interval_start_ns = 0;  ///< of the earlier frame
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< earlier from later body
  Matrix6d covariance = Matrix6d::Zero();  ///< translation, rotation vector; earlier body's axes
  bool metric = false;                     ///< false: the length of the translation is arbitrary
  std::uint32_t inliers = 0;               ///< points that agree
};

/// What the fused pose rests on.
enum class FusionMode : std::uint8_t {
  kWaiting = 0,     ///< nothing yet
  kInertial = 1,    ///< steps and heading of pdr only
  kWithVision = 2,  ///< vision's heading rate is used
  kCoasting = 3,    ///< pdr is silent: the pose is held, its covariance grows
};

/// Name of a mode for people: "waiting", "inertial", "with vision", "coasting".
const char* name_of(FusionMode mode);

/// The fused pose.
struct FusedPose {
  PoseEstimate pose;
  double yaw_rad = 0.0;  ///< fused walking direction
  double yaw_rate_radps = 0.0;
  double distance_m = 0.0;  ///< walked since the start
  FusionMode mode = FusionMode::kWaiting;
};

}  // namespace vpdr
