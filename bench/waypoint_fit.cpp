#include "bench/waypoint_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/rotation.hpp"
#include "evaluation/interpolation.hpp"
#include "evaluation/trajectory_errors.hpp"

namespace vpdr::bench {

Honesty honesty_of(const evaluation::RunDirectory& run,
                   const std::vector<dataset::Waypoint>& waypoints) {
  const auto& fused = run.fused;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Honesty honesty;
  const double share = 1.0 / static_cast<double>(waypoints.size() - 1);
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const auto later = std::partition_point(fused.begin(), fused.end(), [&](const auto& pose) {
      return pose.stamp_ns < waypoints[i].stamp_ns;
    });
    const auto k = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(later - fused.begin(), std::ssize(fused) - 1));
    const Eigen::Vector2d offset = fused[k].position_m.head<2>() - waypoints[i].position_m;
    if (i == 0) {
      origin = offset;
      continue;
    }
    const Eigen::Vector2d error = offset - origin;
    const double squared = error.dot(run.covariance[k].position_m2.inverse() * error);
    honesty.nees += share * 0.5 * squared;
    honesty.inside_percent += squared < evaluation::kChiSquare95TwoDof ? 100.0 * share : 0.0;
  }
  return honesty;
}

Fitted fitted_to_waypoints(const evaluation::RunDirectory& run,
                           const std::vector<dataset::Waypoint>& waypoints) {
  using Complex = std::complex<double>;
  const auto place = [&](std::size_t i) {
    const Eigen::Vector3d p = evaluation::position_at(run.fused, waypoints[i].stamp_ns);
    return Complex(p.x(), p.y());
  };
  const auto truth = [&](std::size_t i) {
    const Eigen::Vector2d d = waypoints[i].position_m - waypoints[0].position_m;
    return Complex(d.x(), d.y());
  };
  Complex product;
  double squared = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    product += std::conj(place(i) - place(0)) * truth(i);
    squared += std::norm(place(i) - place(0));
  }
  const Complex turn = product / std::abs(product);
  Fitted fitted;
  fitted.turn_deg = to_degrees(std::arg(turn));
  const double share = 1.0 / static_cast<double>(waypoints.size() - 1);
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Complex walked = place(i) - place(0);
    fitted.turned_m += share * std::abs(turn * walked - truth(i));
    fitted.scaled_m += share * std::abs(product / squared * walked - truth(i));
  }
  return fitted;
}

}  // namespace vpdr::bench
