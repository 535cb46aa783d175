#include "simulation/reference_path.hpp"

#include <algorithm>
#include <iterator>

#include "core/errors.hpp"

namespace vpdr::simulation {
namespace {

constexpr TimestampNs kLargestGapNs = kNsPerSecond / 10;

}  // namespace

ReferencePath::ReferencePath(const std::vector<PathPose>& poses) {
  for (const PathPose& pose : poses) {
    const bool is_good = pose.position_m.allFinite() && pose.world_from_body.coeffs().allFinite() &&
                         pose.world_from_body.norm() > 0.1;
    if (!is_good || (!poses_.empty() && pose.stamp_ns <= poses_.back().stamp_ns)) continue;
    poses_.push_back(pose);
    poses_.back().world_from_body.normalize();
  }
  if (poses_.size() < 2) throw ConfigurationFault("path: needs two poses at least");
}

double ReferencePath::length_m() const {
  double length = 0.0;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    length += (poses_[i].position_m - poses_[i - 1].position_m).norm();
  }
  return length;
}

std::vector<PathPose>::const_iterator ReferencePath::after(TimestampNs stamp_ns) const {
  return std::lower_bound(poses_.begin(), poses_.end(), stamp_ns,
                          [](const PathPose& p, TimestampNs at) { return p.stamp_ns < at; });
}

Eigen::Isometry3d ReferencePath::at(TimestampNs stamp_ns) const {
  const auto next = after(std::clamp(stamp_ns, begin_ns(), end_ns()));
  const PathPose& b = *next;
  const PathPose& a = next == poses_.begin() ? b : *std::prev(next);
  const double share = &a == &b ? 0.0
                                : to_seconds(std::min(stamp_ns, end_ns()) - a.stamp_ns) /
                                      to_seconds(b.stamp_ns - a.stamp_ns);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = a.world_from_body.slerp(share, b.world_from_body).toRotationMatrix();
  pose.translation() = a.position_m + share * (b.position_m - a.position_m);
  return pose;
}

bool ReferencePath::is_known(TimestampNs stamp_ns, TimestampNs gap_ns) const {
  const auto next = after(stamp_ns);
  if (next == poses_.end()) return false;
  if (next->stamp_ns == stamp_ns) return true;
  if (next == poses_.begin()) return false;
  return next->stamp_ns - stamp_ns <= gap_ns && stamp_ns - std::prev(next)->stamp_ns <= gap_ns;
}

std::vector<TimestampNs> frames_along(const ReferencePath& path, double rate_hz) {
  std::vector<TimestampNs> frames;
  if (!(rate_hz > 0.0)) return frames;
  for (std::int64_t k = 0;; ++k) {
    const TimestampNs stamp = path.begin_ns() + to_ns(static_cast<double>(k) / rate_hz);
    if (stamp > path.end_ns()) return frames;
    if (path.is_known(stamp, kLargestGapNs)) frames.push_back(stamp);
  }
}

}  // namespace vpdr::simulation
