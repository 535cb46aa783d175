#include "evaluation/interpolation.hpp"

#include <algorithm>

namespace vpdr::evaluation {
namespace {

constexpr TimestampNs kLongestGapNs = kNsPerSecond / 2;

/// First row with a stamp not before `stamp_ns`.
template <class Row>
auto first_not_before(const std::vector<Row>& rows, TimestampNs stamp_ns) {
  return std::lower_bound(rows.begin(), rows.end(), stamp_ns,
                          [](const Row& row, TimestampNs t) { return row.stamp_ns < t; });
}

/// Where `t` lies between two stamps, 0 to 1.
double fraction_between(TimestampNs before, TimestampNs after, TimestampNs t) {
  return static_cast<double>(t - before) / static_cast<double>(after - before);
}

}  // namespace

Eigen::Vector3d position_at(const std::vector<StampedPose>& poses, TimestampNs stamp_ns) {
  const auto after = first_not_before(poses, stamp_ns);
  if (after == poses.begin()) return poses.front().position_m;
  if (after == poses.end()) return poses.back().position_m;
  const auto before = after - 1;
  const double fraction = fraction_between(before->stamp_ns, after->stamp_ns, stamp_ns);
  return before->position_m + fraction * (after->position_m - before->position_m);
}

const StampedCovariance& covariance_at(const std::vector<StampedCovariance>& rows,
                                       TimestampNs stamp_ns) {
  const auto after = first_not_before(rows, stamp_ns);
  if (after != rows.end() && after->stamp_ns == stamp_ns) return *after;
  return after == rows.begin() ? *after : *(after - 1);
}

std::optional<Eigen::Quaterniond> attitude_at(const std::vector<StampedAttitude>& rows,
                                              TimestampNs stamp_ns) {
  const auto after = first_not_before(rows, stamp_ns);
  if (after == rows.end()) return std::nullopt;
  if (after->stamp_ns == stamp_ns) return after->world_from_body;
  if (after == rows.begin()) return std::nullopt;
  const auto before = after - 1;
  if (after->stamp_ns - before->stamp_ns > kLongestGapNs) return std::nullopt;
  const double fraction = fraction_between(before->stamp_ns, after->stamp_ns, stamp_ns);
  return before->world_from_body.slerp(fraction, after->world_from_body);
}

}  // namespace vpdr::evaluation
