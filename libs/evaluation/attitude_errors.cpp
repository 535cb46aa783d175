#include "evaluation/attitude_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "evaluation/interpolation.hpp"

namespace vpdr::evaluation {
namespace {

struct AttitudePair {
  Eigen::Quaterniond estimate;
  Eigen::Quaterniond reference;
};

bool in_any(const std::vector<dataset::Interval>& intervals, TimestampNs t) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [t](const auto& interval) { return interval.contains(t); });
}

bool counts(const dataset::Recording& recording, const dataset::TruthPose& pose) {
  if (!pose.has_attitude()) return false;
  if (recording.truth.movement && !in_any(*recording.truth.movement, pose.stamp_ns)) return false;
  return !in_any(recording.about.reference_faults, pose.stamp_ns);
}

std::vector<AttitudePair> pairs_of(const RunDirectory& run, const dataset::Recording& recording) {
  const Eigen::Quaterniond body_from_sensor(recording.about.mount);
  std::vector<AttitudePair> pairs;
  for (const dataset::TruthPose& pose : recording.truth.poses) {
    if (!counts(recording, pose)) continue;
    const auto estimate = attitude_at(run.attitude, pose.stamp_ns);
    if (estimate) pairs.push_back({*estimate * body_from_sensor, pose.world_from_sensor});
  }
  return pairs;
}

/// Turns every estimate about the vertical by the mean heading error.
void align_heading(std::vector<AttitudePair>& pairs) {
  double sum_sin = 0.0;
  double sum_cos = 0.0;
  for (const AttitudePair& pair : pairs) {
    const Eigen::Quaterniond error = pair.estimate * pair.reference.conjugate();
    const double angle = 2.0 * std::atan2(error.z(), error.w());
    sum_sin += std::sin(angle);
    sum_cos += std::cos(angle);
  }
  const double mean = std::atan2(sum_sin, sum_cos);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-mean, Eigen::Vector3d::UnitZ()));
  for (AttitudePair& pair : pairs) pair.estimate = turn * pair.estimate;
}

}  // namespace

AttitudeError attitude_error(const Eigen::Quaterniond& estimate,
                             const Eigen::Quaterniond& reference) {
  const Eigen::Quaterniond e = (estimate * reference.conjugate()).normalized();
  // The atan2 forms equal the definition and stay exact for small angles, where acos does not.
  const double vertical = std::hypot(e.w(), e.z());
  const double horizontal = std::hypot(e.x(), e.y());
  return {2.0 * std::atan2(e.vec().norm(), std::abs(e.w())),
          2.0 * std::atan2(std::abs(e.z()), std::abs(e.w())),
          2.0 * std::atan2(horizontal, vertical)};
}

std::optional<AttitudeRmse> attitude_rmse(const RunDirectory& run,
                                          const dataset::Recording& recording) {
  std::vector<AttitudePair> pairs = pairs_of(run, recording);
  if (pairs.empty()) return std::nullopt;
  AttitudeRmse rmse;
  rmse.heading_aligned = recording.mag.empty();
  if (rmse.heading_aligned) align_heading(pairs);
  double total = 0.0;
  double heading = 0.0;
  double inclination = 0.0;
  for (const AttitudePair& pair : pairs) {
    const AttitudeError error = attitude_error(pair.estimate, pair.reference);
    total += error.total_rad * error.total_rad;
    heading += error.heading_rad * error.heading_rad;
    inclination += error.inclination_rad * error.inclination_rad;
  }
  const auto n = static_cast<double>(pairs.size());
  rmse.samples = pairs.size();
  rmse.total_deg = to_degrees(std::sqrt(total / n));
  rmse.heading_deg = to_degrees(std::sqrt(heading / n));
  rmse.inclination_deg = to_degrees(std::sqrt(inclination / n));
  return rmse;
}

}  // namespace vpdr::evaluation
