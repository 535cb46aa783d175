#pragma once
// Between the core's types and the messages. to_msg fills a message that the caller keeps, so that
// nothing is allocated; from_msg reads one. SI on both sides, but for the magnetic field:
// microtesla in the core, tesla on the wire. Quaternions are w x y z in the core, x y z w on the
// wire. Covariances are row major. Thread safety: pure functions.
//
// Every number makes the round trip as it is (the magnetic field to the last bit but one). What a
// standard ROS type has no room for is named at its function.
#include <string>

#include "calibration/board_calibration.hpp"
#include "core/estimates.hpp"
#include "core/samples.hpp"
#include "core/sensor_streams.hpp"

namespace builtin_interfaces::msg {
class Time;
}
namespace geometry_msgs::msg {
class PoseStamped;
class PoseWithCovarianceStamped;
}  // namespace geometry_msgs::msg
namespace nav_msgs::msg {
class Odometry;
}
namespace sensor_msgs::msg {
class FluidPressure;
class Imu;
class MagneticField;
class Temperature;
}  // namespace sensor_msgs::msg
namespace vpdr_msgs::msg {
class Calibration;
class CorridorHeading;
class FusionState;
class Heading;
class HeadingRate;
class Motion;
class Step;
}  // namespace vpdr_msgs::msg

namespace vpdr::dds {

/// REP-105: map -> odom -> base_link -> imu_link.
enum class Frame { kMap, kOdom, kBaseLink, kImuLink };

/// "map", "odom", "base_link", "imu_link".
const char* name_of(Frame frame);

/// Times from 1901 to 2038 fit on the wire (32 bits of seconds); others are held at the ends.
void to_msg(TimestampNs stamp_ns, builtin_interfaces::msg::Time& out);
TimestampNs from_msg(const builtin_interfaces::msg::Time& msg);

/// imu/data_raw: no orientation (its covariance begins with -1); without a gyroscope the covariance
/// of the angular velocity begins with -1. Frame imu_link, whose axes are the body's.
void to_msg(const ImuSample& sample, sensor_msgs::msg::Imu& out);
void from_msg(const sensor_msgs::msg::Imu& msg, ImuSample& out);

void to_msg(const MagSample& sample, sensor_msgs::msg::MagneticField& out);
void from_msg(const sensor_msgs::msg::MagneticField& msg, MagSample& out);

void to_msg(const PressureSample& sample, sensor_msgs::msg::FluidPressure& out);
void from_msg(const sensor_msgs::msg::FluidPressure& msg, PressureSample& out);

/// Of the board, degrees Celsius.
void to_msg(const TimedValue& temperature_c, sensor_msgs::msg::Temperature& out);
void from_msg(const sensor_msgs::msg::Temperature& msg, TimedValue& out);

/// imu/data. Not on the wire: yaw_is_absolute, which pdr/heading tells; from_msg leaves it alone.
void to_msg(const AttitudeEstimate& attitude, sensor_msgs::msg::Imu& out);
void from_msg(const sensor_msgs::msg::Imu& msg, AttitudeEstimate& out);

void to_msg(const StepEvent& step, vpdr_msgs::msg::Step& out);
void from_msg(const vpdr_msgs::msg::Step& msg, StepEvent& out);

void to_msg(const HeadingEstimate& heading, vpdr_msgs::msg::Heading& out);
void from_msg(const vpdr_msgs::msg::Heading& msg, HeadingEstimate& out);

/// The speed is the twist's forward component.
void to_msg(const PoseEstimate& pose, Frame frame, nav_msgs::msg::Odometry& out);
void from_msg(const nav_msgs::msg::Odometry& msg, PoseEstimate& out);

/// Not on the wire: angular velocity and speed; from_msg leaves them alone.
void to_msg(const PoseEstimate& pose, Frame frame,
            geometry_msgs::msg::PoseWithCovarianceStamped& out);
void from_msg(const geometry_msgs::msg::PoseWithCovarianceStamped& msg, PoseEstimate& out);

/// A point of a path: stamp, position and attitude only.
void to_msg(const PoseEstimate& pose, Frame frame, geometry_msgs::msg::PoseStamped& out);

void to_msg(const CorridorHeading& heading, vpdr_msgs::msg::CorridorHeading& out);
void from_msg(const vpdr_msgs::msg::CorridorHeading& msg, CorridorHeading& out);

void to_msg(const HeadingRate& rate, vpdr_msgs::msg::HeadingRate& out);
void from_msg(const vpdr_msgs::msg::HeadingRate& msg, HeadingRate& out);

void to_msg(const MotionEstimate& motion, vpdr_msgs::msg::Motion& out);
void from_msg(const vpdr_msgs::msg::Motion& msg, MotionEstimate& out);

/// Everything of the fused pose, in the map frame.
void to_msg(const FusedPose& pose, vpdr_msgs::msg::FusionState& out);
void from_msg(const vpdr_msgs::msg::FusionState& msg, FusedPose& out);

/// Corrections, mount and field. On the wire each sensor's axes are part of its scale: from_msg
/// leaves `axes` the identity. Dates, residuals and noise stay in the file.
void to_msg(const calibration::BoardCalibration& board, TimestampNs stamp_ns,
            vpdr_msgs::msg::Calibration& out);
void from_msg(const vpdr_msgs::msg::Calibration& msg, calibration::BoardCalibration& out);

}  // namespace vpdr::dds
