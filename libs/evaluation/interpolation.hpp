#pragma once
// Estimates at the instants of the truth.
#include <optional>
#include <vector>

#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// Position at `stamp_ns`, linear between the two poses around it; before the first and after the
/// last pose, that pose's. `poses` must not be empty.
Eigen::Vector3d position_at(const std::vector<StampedPose>& poses, TimestampNs stamp_ns);

/// Covariance at `stamp_ns`: of the row at or before it, else the first. Must not be empty.
const StampedCovariance& covariance_at(const std::vector<StampedCovariance>& rows,
                                       TimestampNs stamp_ns);

/// Attitude at `stamp_ns` by slerp; nullopt outside the rows and in gaps longer than half a second.
std::optional<Eigen::Quaterniond> attitude_at(const std::vector<StampedAttitude>& rows,
                                              TimestampNs stamp_ns);

}  // namespace vpdr::evaluation
