#pragma once
// Eigen to and from the geometry messages; shared by the converters.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "core/time.hpp"
#include "dds/convert.hpp"
#include "geometry_msgs.h"

namespace vpdr::dds::detail {

inline void to_msg(TimestampNs stamp_ns, Frame frame, std_msgs::msg::Header& out) {
  dds::to_msg(stamp_ns, out.stamp());
  out.frame_id() = name_of(frame);  // short enough for the string's own buffer
}

template <class Xyz>
void to_xyz(const Eigen::Vector3d& v, Xyz& out) {
  out.x(v.x());
  out.y(v.y());
  out.z(v.z());
}

template <class Xyz>
Eigen::Vector3d from_xyz(const Xyz& msg) {
  return {msg.x(), msg.y(), msg.z()};
}

inline void to_msg(const Eigen::Quaterniond& q, geometry_msgs::msg::Quaternion& out) {
  out.w(q.w());
  out.x(q.x());
  out.y(q.y());
  out.z(q.z());
}

inline Eigen::Quaterniond from_msg(const geometry_msgs::msg::Quaternion& msg) {
  return {msg.w(), msg.x(), msg.y(), msg.z()};
}

template <int N, std::size_t Size>
void to_rows(const Eigen::Matrix<double, N, N>& m, std::array<double, Size>& out) {
  static_assert(Size == std::size_t{N} * N);
  Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>(out.data()) = m;
}

template <int N, std::size_t Size>
Eigen::Matrix<double, N, N> from_rows(const std::array<double, Size>& rows) {
  static_assert(Size == std::size_t{N} * N);
  return Eigen::Map<const Eigen::Matrix<double, N, N, Eigen::RowMajor>>(rows.data());
}

inline void to_msg(const PoseEstimate& pose, geometry_msgs::msg::Pose& out) {
  to_xyz(pose.position_m, out.position());
  to_msg(pose.world_from_body, out.orientation());
}

inline void to_msg(const PoseEstimate& pose, geometry_msgs::msg::PoseWithCovariance& out) {
  to_msg(pose, out.pose());
  to_rows<6>(pose.covariance, out.covariance());
}

inline void from_msg(const geometry_msgs::msg::PoseWithCovariance& msg, PoseEstimate& out) {
  out.position_m = from_xyz(msg.pose().position());
  out.world_from_body = from_msg(msg.pose().orientation());
  out.covariance = from_rows<6>(msg.covariance());
}

}  // namespace vpdr::dds::detail
