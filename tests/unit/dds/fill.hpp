#pragma once
// Fills messages of every type so that each field differs from its default and its neighbours.
#include <cstdint>
#include <string>

#include "diagnostic_msgs.h"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::dds::test {

class Filler {
 public:
  void fill(builtin_interfaces::msg::Time& m) {
    m.sec(-static_cast<std::int32_t>(next()));
    m.nanosec(next());
  }
  void fill(builtin_interfaces::msg::Duration& m) {
    m.sec(static_cast<std::int32_t>(next()));
    m.nanosec(next());
  }
  void fill(std_msgs::msg::Header& m) {
    fill(m.stamp());
    m.frame_id(text());
  }
  void fill(geometry_msgs::msg::Point& m) { fill_xyz(m); }
  void fill(geometry_msgs::msg::Vector3& m) { fill_xyz(m); }
  void fill(geometry_msgs::msg::Quaternion& m) {
    fill_xyz(m);
    m.w(number());
  }
  void fill(geometry_msgs::msg::Pose& m) { fill_all(m.position(), m.orientation()); }
  void fill(geometry_msgs::msg::PoseWithCovariance& m) { fill_all(m.pose(), m.covariance()); }
  void fill(geometry_msgs::msg::PoseStamped& m) { fill_all(m.header(), m.pose()); }
  void fill(geometry_msgs::msg::PoseWithCovarianceStamped& m) { fill_all(m.header(), m.pose()); }
  void fill(geometry_msgs::msg::Twist& m) { fill_all(m.linear(), m.angular()); }
  void fill(geometry_msgs::msg::TwistWithCovariance& m) { fill_all(m.twist(), m.covariance()); }
  void fill(sensor_msgs::msg::Imu& m) {
    fill_all(m.header(), m.orientation(), m.orientation_covariance(), m.angular_velocity(),
             m.angular_velocity_covariance(), m.linear_acceleration(),
             m.linear_acceleration_covariance());
  }
  void fill(sensor_msgs::msg::MagneticField& m) {
    fill_all(m.header(), m.magnetic_field(), m.magnetic_field_covariance());
  }
  void fill(sensor_msgs::msg::FluidPressure& m) {
    fill_all(m.header(), m.fluid_pressure(), m.variance());
  }
  void fill(sensor_msgs::msg::Temperature& m) {
    fill_all(m.header(), m.temperature(), m.variance());
  }
  void fill(sensor_msgs::msg::CompressedImage& m) {
    fill_all(m.header(), m.format());
    for (int i = 0; i < 1001; ++i) m.data().push_back(static_cast<std::uint8_t>(next()));
  }
  void fill(nav_msgs::msg::Odometry& m) {
    fill_all(m.header(), m.child_frame_id(), m.pose(), m.twist());
  }
  void fill(nav_msgs::msg::Path& m) {
    fill(m.header());
    m.poses().resize(3);
    for (auto& pose : m.poses()) fill(pose);
  }
  void fill(diagnostic_msgs::msg::KeyValue& m) { fill_all(m.key(), m.value()); }
  void fill(diagnostic_msgs::msg::DiagnosticStatus& m) {
    fill_all(m.level(), m.name(), m.message(), m.hardware_id());
    m.values().resize(2);
    for (auto& value : m.values()) fill(value);
  }
  void fill(diagnostic_msgs::msg::DiagnosticArray& m) {
    fill(m.header());
    m.status().resize(2);
    for (auto& status : m.status()) fill(status);
  }
  void fill(vpdr_msgs::msg::Step& m) {
    fill_all(m.header(), m.index(), m.length(), m.length_sigma(), m.frequency(), m.yaw(),
             m.yaw_sigma(), m.status(), m.probability());
  }
  void fill(vpdr_msgs::msg::Heading& m) {
    fill_all(m.header(), m.yaw(), m.yaw_sigma(), m.absolute());
  }
  void fill(vpdr_msgs::msg::CorridorHeading& m) {
    fill_all(m.header(), m.found(), m.heading(), m.pitch(), m.sigma(), m.inliers());
  }
  void fill(vpdr_msgs::msg::HeadingRate& m) {
    fill_all(m.header(), m.interval_start(), m.rate(), m.sigma());
  }
  void fill(vpdr_msgs::msg::Motion& m) {
    fill_all(m.header(), m.interval_start(), m.motion(), m.metric(), m.inliers());
  }
  void fill(vpdr_msgs::msg::Loop& m) {
    fill_all(m.header(), m.matched(), m.relative_pose(), m.inliers(), m.score());
  }
  void fill(vpdr_msgs::msg::Calibration& m) {
    fill_all(m.header(), m.board(), m.serial(), m.gyroscope_bias(), m.gyroscope_scale(),
             m.accelerometer_bias(), m.accelerometer_scale(), m.magnetometer_bias(),
             m.magnetometer_scale(), m.mount(), m.field_strength(), m.field_dip(),
             m.step_length_per_hz(), m.step_length_offset());
  }
  void fill(vpdr_msgs::msg::Progress& m) { fill_all(m.header(), m.service()); }
  void fill(vpdr_msgs::msg::FusionState& m) {
    fill_all(m.header(), m.pose(), m.angular_velocity(), m.speed(), m.yaw(), m.yaw_rate(),
             m.distance(), m.mode());
  }

 private:
  void fill(double& value) { value = number(); }
  void fill(std::uint32_t& value) { value = next(); }
  void fill(std::uint8_t& value) { value = static_cast<std::uint8_t>(next()); }
  void fill(bool& value) { value = true; }
  void fill(std::string& value) { value = text(); }
  template <std::size_t N>
  void fill(std::array<double, N>& values) {
    for (auto& value : values) value = number();
  }
  template <class Xyz>
  void fill_xyz(Xyz& m) {
    fill_all(m.x(), m.y(), m.z());
  }
  template <class... Fields>
  void fill_all(Fields&... fields) {
    (fill(fields), ...);
  }

  std::uint32_t next() { return ++count_; }
  double number() { return 0.37 * next(); }
  std::string text() { return std::string(1 + next() % 7, 'a') + std::to_string(next()); }

  std::uint32_t count_ = 0;
};

}  // namespace vpdr::dds::test
