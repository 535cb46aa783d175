#include "dds/convert.hpp"
#include "dds/detail/convert_geometry.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::dds {

using detail::from_rows;
using detail::from_xyz;
using detail::to_rows;
using detail::to_xyz;

void to_msg(const AttitudeEstimate& attitude, sensor_msgs::msg::Imu& out) {
  detail::to_msg(attitude.stamp_ns, Frame::kBaseLink, out.header());
  detail::to_msg(attitude.world_from_body, out.orientation());
  to_rows<3>(attitude.covariance_rad2, out.orientation_covariance());
  to_xyz(attitude.angular_velocity_radps, out.angular_velocity());
  out.angular_velocity_covariance().fill(0.0);
  to_xyz(attitude.specific_force_mps2, out.linear_acceleration());
  out.linear_acceleration_covariance().fill(0.0);
}

void from_msg(const sensor_msgs::msg::Imu& msg, AttitudeEstimate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.world_from_body = detail::from_msg(msg.orientation());
  out.covariance_rad2 = from_rows<3>(msg.orientation_covariance());
  out.angular_velocity_radps = from_xyz(msg.angular_velocity());
  out.specific_force_mps2 = from_xyz(msg.linear_acceleration());
}

void to_msg(const StepEvent& step, vpdr_msgs::msg::Step& out) {
  detail::to_msg(step.stamp_ns, Frame::kOdom, out.header());
  out.index(step.index);
  out.length(step.length_m);
  out.length_sigma(step.length_sigma_m);
  out.frequency(step.frequency_hz);
  out.yaw(step.yaw_rad);
  out.yaw_sigma(step.yaw_sigma_rad);
  out.yaw_revision(step.yaw_revision_rad);
  out.status(static_cast<std::uint8_t>(step.status));
  out.probability(step.probability);
}

void from_msg(const vpdr_msgs::msg::Step& msg, StepEvent& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.index = msg.index();
  out.length_m = msg.length();
  out.length_sigma_m = msg.length_sigma();
  out.frequency_hz = msg.frequency();
  out.yaw_rad = msg.yaw();
  out.yaw_sigma_rad = msg.yaw_sigma();
  out.yaw_revision_rad = msg.yaw_revision();
  // A status of a later version: nothing final is known of the step here.
  constexpr auto kLastStatus = static_cast<std::uint8_t>(StepStatus::kWithdrawn);
  out.status =
      msg.status() <= kLastStatus ? static_cast<StepStatus>(msg.status()) : StepStatus::kTentative;
  out.probability = msg.probability();
}

void to_msg(const HeadingEstimate& heading, vpdr_msgs::msg::Heading& out) {
  detail::to_msg(heading.stamp_ns, Frame::kOdom, out.header());
  out.yaw(heading.yaw_rad);
  out.yaw_sigma(heading.yaw_sigma_rad);
  out.yaw_zero_sigma(heading.yaw_zero_sigma_rad);
  out.yaw_revision(heading.yaw_revision_rad);
  out.absolute(heading.yaw_is_absolute);
}

void from_msg(const vpdr_msgs::msg::Heading& msg, HeadingEstimate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.yaw_rad = msg.yaw();
  out.yaw_sigma_rad = msg.yaw_sigma();
  out.yaw_zero_sigma_rad = msg.yaw_zero_sigma();
  out.yaw_revision_rad = msg.yaw_revision();
  out.yaw_is_absolute = msg.absolute();
}

void to_msg(const PoseEstimate& pose, Frame frame, nav_msgs::msg::Odometry& out) {
  detail::to_msg(pose.stamp_ns, frame, out.header());
  out.child_frame_id() = name_of(Frame::kBaseLink);
  detail::to_msg(pose, out.pose());
  to_xyz({pose.speed_mps, 0.0, 0.0}, out.twist().twist().linear());
  to_xyz(pose.angular_velocity_radps, out.twist().twist().angular());
  out.twist().covariance().fill(0.0);
}

void from_msg(const nav_msgs::msg::Odometry& msg, PoseEstimate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  detail::from_msg(msg.pose(), out);
  out.angular_velocity_radps = from_xyz(msg.twist().twist().angular());
  out.speed_mps = msg.twist().twist().linear().x();
}

void to_msg(const PoseEstimate& pose, Frame frame,
            geometry_msgs::msg::PoseWithCovarianceStamped& out) {
  detail::to_msg(pose.stamp_ns, frame, out.header());
  detail::to_msg(pose, out.pose());
}

void from_msg(const geometry_msgs::msg::PoseWithCovarianceStamped& msg, PoseEstimate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  detail::from_msg(msg.pose(), out);
}

void to_msg(const PoseEstimate& pose, Frame frame, geometry_msgs::msg::PoseStamped& out) {
  detail::to_msg(pose.stamp_ns, frame, out.header());
  detail::to_msg(pose, out.pose());
}

void to_msg(const CorridorHeading& heading, vpdr_msgs::msg::CorridorHeading& out) {
  detail::to_msg(heading.stamp_ns, Frame::kBaseLink, out.header());
  out.found(heading.found);
  out.heading(heading.heading_rad);
  out.pitch(heading.pitch_rad);
  out.sigma(heading.sigma_rad);
  out.inliers(heading.inliers);
}

void from_msg(const vpdr_msgs::msg::CorridorHeading& msg, CorridorHeading& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.found = msg.found();
  out.heading_rad = msg.heading();
  out.pitch_rad = msg.pitch();
  out.sigma_rad = msg.sigma();
  out.inliers = msg.inliers();
}

void to_msg(const HeadingRate& rate, vpdr_msgs::msg::HeadingRate& out) {
  detail::to_msg(rate.stamp_ns, Frame::kBaseLink, out.header());
  to_msg(rate.interval_start_ns, out.interval_start());
  out.rate(rate.rate_radps);
  out.sigma(rate.sigma_radps);
}

void from_msg(const vpdr_msgs::msg::HeadingRate& msg, HeadingRate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.interval_start_ns = from_msg(msg.interval_start());
  out.rate_radps = msg.rate();
  out.sigma_radps = msg.sigma();
}

void to_msg(const MotionEstimate& motion, vpdr_msgs::msg::Motion& out) {
  detail::to_msg(motion.stamp_ns, Frame::kBaseLink, out.header());
  to_msg(motion.interval_start_ns, out.interval_start());
  to_xyz(motion.translation_m, out.motion().pose().position());
  detail::to_msg(motion.rotation, out.motion().pose().orientation());
  to_rows<6>(motion.covariance, out.motion().covariance());
  out.metric(motion.metric);
  out.inliers(motion.inliers);
}

void from_msg(const vpdr_msgs::msg::Motion& msg, MotionEstimate& out) {
  out.stamp_ns = from_msg(msg.header().stamp());
  out.interval_start_ns = from_msg(msg.interval_start());
  out.translation_m = from_xyz(msg.motion().pose().position());
  out.rotation = detail::from_msg(msg.motion().pose().orientation());
  out.covariance = from_rows<6>(msg.motion().covariance());
  out.metric = msg.metric();
  out.inliers = msg.inliers();
}

void to_msg(const FusedPose& pose, vpdr_msgs::msg::FusionState& out) {
  detail::to_msg(pose.pose.stamp_ns, Frame::kMap, out.header());
  detail::to_msg(pose.pose, out.pose());
  to_xyz(pose.pose.angular_velocity_radps, out.angular_velocity());
  out.speed(pose.pose.speed_mps);
  out.yaw(pose.yaw_rad);
  out.yaw_rate(pose.yaw_rate_radps);
  out.distance(pose.distance_m);
  out.mode(static_cast<std::uint8_t>(pose.mode));
}

void from_msg(const vpdr_msgs::msg::FusionState& msg, FusedPose& out) {
  out.pose.stamp_ns = from_msg(msg.header().stamp());
  detail::from_msg(msg.pose(), out.pose);
  out.pose.angular_velocity_radps = from_xyz(msg.angular_velocity());
  out.pose.speed_mps = msg.speed();
  out.yaw_rad = msg.yaw();
  out.yaw_rate_radps = msg.yaw_rate();
  out.distance_m = msg.distance();
  // A mode of a later version: nothing is known of it here.
  constexpr auto kLastMode = static_cast<std::uint8_t>(FusionMode::kCoasting);
  out.mode = msg.mode() <= kLastMode ? static_cast<FusionMode>(msg.mode()) : FusionMode::kWaiting;
}

}  // namespace vpdr::dds
