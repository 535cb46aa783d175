#include "evaluation/waypoint_errors.hpp"

#include <algorithm>

#include "evaluation/interpolation.hpp"

namespace vpdr::evaluation {

std::optional<WaypointErrors> waypoint_errors(const std::vector<StampedPose>& estimate,
                                              const std::vector<dataset::Waypoint>& waypoints) {
  if (estimate.empty() || waypoints.size() < 2) return std::nullopt;
  const auto place_at = [&](TimestampNs t) -> Eigen::Vector2d {
    return position_at(estimate, t).head<2>();
  };
  const Eigen::Vector2d shift = waypoints.front().position_m - place_at(waypoints.front().stamp_ns);
  WaypointErrors errors;
  errors.each_m.push_back(0.0);
  double sum = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Eigen::Vector2d& truth = waypoints[i].position_m;
    const double error = (place_at(waypoints[i].stamp_ns) + shift - truth).norm();
    errors.each_m.push_back(error);
    errors.max_m = std::max(errors.max_m, error);
    errors.path_m += (truth - waypoints[i - 1].position_m).norm();
    sum += error;
  }
  errors.mean_m = sum / static_cast<double>(waypoints.size() - 1);
  errors.final_m = errors.each_m.back();
  errors.final_percent = errors.path_m > 0.0 ? 100.0 * errors.final_m / errors.path_m : 0.0;
  return errors;
}

}  // namespace vpdr::evaluation
