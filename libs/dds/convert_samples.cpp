#include <algorithm>

#include "dds/convert.hpp"
#include "dds/detail/convert_geometry.hpp"
#include "sensor_msgs.h"

namespace vpdr::dds {
namespace {

using detail::from_xyz;
using detail::to_xyz;

constexpr double kAbsent = -1.0;  // sensor_msgs/Imu: this quantity is not measured
constexpr double kUtPerTesla = 1e6;
constexpr TimestampNs kFirstNs = -(TimestampNs{1} << 31) * kNsPerSecond;
constexpr TimestampNs kLastNs = (TimestampNs{1} << 31) * kNsPerSecond - 1;

}  // namespace

const char* name_of(Frame frame) {
  switch (frame) {
    case Frame::kMap:
      return "map";
    case Frame::kOdom:
      return "odom";
    case Frame::kBaseLink:
      return "base_link";
    case Frame::kImuLink:
      return "imu_link";
  }
  return "";
}

void to_msg(TimestampNs stamp_ns, builtin_interfaces::msg::Time& out) {
  const TimestampNs held = std::clamp(stamp_ns, kFirstNs, kLastNs);
  TimestampNs seconds = held / kNsPerSecond;
  if (held % kNsPerSecond < 0) --seconds;  // nanosec counts upwards, before zero too
  out.sec(static_cast<std::int32_t>(seconds));
  out.nanosec(static_cast<std::uint32_t>(held - seconds * kNsPerSecond));
}

TimestampNs from_msg(const builtin_interfaces::msg::Time& msg) {
  return msg.sec() * kNsPerSecond + msg.nanosec();
}

void to_msg(const ImuSample& sample, sensor_msgs::msg::Imu& out) {
  detail::to_msg(sample.stamp_ns, Frame::kImuLink, out.header());
  detail::to_msg(Eigen::Quaterniond::Identity(), out.orientation());
  out.orientation_covariance().fill(0.0);
  out.orientation_covariance()[0] = kAbsent;
  to_xyz(sample.angular_velocity_radps, out.angular_velocity());
  out.angular_velocity_covariance().fill(0.0);
  if (!sample.has_angular_velocity) out.angular_velocity_covariance()[0] = kAbsent;
  to_xyz(sample.specific_force_mps2, out.linear_acceleration());
  out.linear_acceleration_covariance().fill(0.0);
}

void from_msg(const sensor_msgs::msg::Imu& msg, ImuSample& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.specific_force_mps2 = from_xyz(msg.linear_acceleration());
  out.angular_velocity_radps = from_xyz(msg.angular_velocity());
  out.has_angular_velocity = msg.angular_velocity_covariance()[0] != kAbsent;
}

void to_msg(const MagSample& sample, sensor_msgs::msg::MagneticField& out) {
  detail::to_msg(sample.stamp_ns, Frame::kImuLink, out.header());
  to_xyz(sample.field_ut / kUtPerTesla, out.magnetic_field());
  out.magnetic_field_covariance().fill(0.0);
}

void from_msg(const sensor_msgs::msg::MagneticField& msg, MagSample& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.field_ut = from_xyz(msg.magnetic_field()) * kUtPerTesla;
}

void to_msg(const PressureSample& sample, sensor_msgs::msg::FluidPressure& out) {
  detail::to_msg(sample.stamp_ns, Frame::kImuLink, out.header());
  out.fluid_pressure(sample.pressure_pa);
  out.variance(0.0);
}

void from_msg(const sensor_msgs::msg::FluidPressure& msg, PressureSample& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.pressure_pa = msg.fluid_pressure();
}

void to_msg(const TimedValue& temperature_c, sensor_msgs::msg::Temperature& out) {
  detail::to_msg(temperature_c.stamp_ns, Frame::kImuLink, out.header());
  out.temperature(temperature_c.value);
  out.variance(0.0);
}

void from_msg(const sensor_msgs::msg::Temperature& msg, TimedValue& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.value = msg.temperature();
}

}  // namespace vpdr::dds
