// What pdr says with a sample: heading and odometry.
#include <algorithm>
#include <cmath>

#include "core/last_step.hpp"
#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"

namespace vpdr::pdr {

HeadingEstimate Pdr::heading_at(TimestampNs stamp_ns) const {
  // A walk is known a sample or two before the first of its steps is taken.
  const bool steps_tell = steps_.walking() && !sequence_.empty();
  const double window_s =
      steps_tell ? 1.0 / sequence_.last().frequency_hz : config_.heading.window_s;
  const WalkingHeading::Mean mean = heading_.mean(stamp_ns - to_ns(window_s), stamp_ns);
  const double relative = mean.clarity > 0.0 ? mean.yaw_rad : yaw_of(relative_.odom_from_body());
  HeadingEstimate out;
  out.stamp_ns = stamp_ns;
  out.yaw_rad = wrap_pi(relative + dead_reckoning_.walking_offset_rad());
  const double common = std::sqrt(dead_reckoning_.walking_variance_rad2());
  out.yaw_sigma_rad = std::min(kPi, std::hypot(common, mean.unclear_sigma_rad()));
  out.yaw_is_absolute = dead_reckoning_.yaw_is_absolute();
  out.yaw_zero_sigma_rad = std::sqrt(dead_reckoning_.zero_variance_rad2());
  out.yaw_revision_rad = dead_reckoning_.revision_rad();
  return out;
}

PoseEstimate Pdr::odometry(TimestampNs stamp_ns) const {
  const Eigen::AngleAxisd world_from_odom(dead_reckoning_.offset_rad(), Eigen::Vector3d::UnitZ());
  PoseEstimate pose;
  pose.stamp_ns = stamp_ns;
  pose.world_from_body = (world_from_odom * relative_.odom_from_body()).normalized();
  pose.angular_velocity_radps = relative_.rate_radps();
  pose.position_m.head<2>() =
      dead_reckoning_.position_m() + tentative_.displacement_m(dead_reckoning_.revision_rad());
  if (!sequence_.empty()) {
    const double length = sequence_.last_length_m();
    const double frequency = sequence_.last().frequency_hz;
    const double since = to_seconds(stamp_ns - sequence_.last().stamp_ns);
    pose.position_m.head<2>() +=
        beyond_last_step_m(since, 1.0 / frequency, length) * along_last_step();
    pose.speed_mps = steps_.walking() ? length * frequency : 0.0;
  }
  if (height_.known()) pose.position_m.z() = height_.height_m(stamp_ns);
  pose.covariance = odometry_covariance(stamp_ns);
  return pose;
}

double Pdr::height_variance_m2(TimestampNs stamp_ns) const {
  if (!height_.known()) return dead_reckoning_.height_variance_m2();
  const double sway = config_.dead_reckoning.sway_sigma_m;
  return height_.variance_m2(stamp_ns) + sway * sway;
}

Matrix6d Pdr::odometry_covariance(TimestampNs stamp_ns) const {
  const Eigen::Matrix3d plane = dead_reckoning_.covariance();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<2, 2>() = plane.topLeftCorner<2, 2>() + body_about_steps();
  covariance(2, 2) = height_variance_m2(stamp_ns);
  covariance.diagonal().segment<2>(3).setConstant(relative_.tilt_variance_rad2());
  covariance(5, 5) = plane(2, 2);
  covariance.block<2, 1>(0, 5) = plane.block<2, 1>(0, 2);
  covariance.block<1, 2>(5, 0) = plane.block<1, 2>(2, 0);
  return covariance;
}

Eigen::Vector2d Pdr::along_last_step() const {
  const double yaw = sequence_.last_yaw_rad() + dead_reckoning_.walking_offset_rad();
  return {std::cos(yaw), std::sin(yaw)};
}

Eigen::Matrix2d Pdr::body_about_steps() const {
  const DeadReckoningConfig& config = config_.dead_reckoning;
  Eigen::Matrix2d spread = config.sway_sigma_m * config.sway_sigma_m * Eigen::Matrix2d::Identity();
  if (steps_.walking()) {  // anywhere within the step under way
    const Eigen::Vector2d along = along_last_step();
    const double length = sequence_.last_length_m();
    spread += length * length / 12.0 * along * along.transpose();
  } else {  // a walk may have begun with a step that is under way, in any direction
    const double begun = config.unconfirmed_sigma_m;
    spread += begun * begun * Eigen::Matrix2d::Identity();
  }
  return spread + tentative_.covariance_m2(dead_reckoning_.revision_rad());
}

}  // namespace vpdr::pdr
