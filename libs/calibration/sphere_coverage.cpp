#include "calibration/sphere_coverage.hpp"

#include <cmath>
#include <numbers>

namespace vpdr::calibration {

SphereCoverage::SphereCoverage() {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < kCells; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(kCells);
    const double radius = std::sqrt(1.0 - z * z);
    const double angle = golden_angle * static_cast<double>(i);
    middles_[i] = {radius * std::cos(angle), radius * std::sin(angle), z};
  }
}

void SphereCoverage::add(const Eigen::Vector3d& direction) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < kCells; ++i) {
    if (middles_[i].dot(direction) > middles_[nearest].dot(direction)) nearest = i;
  }
  seen_.set(nearest);
}

double SphereCoverage::share() const {
  return static_cast<double>(seen_.count()) / static_cast<double>(kCells);
}

Eigen::Vector3d SphereCoverage::largest_hole() const {
  std::size_t worst = 0;
  double worst_cosine = 2.0;
  for (std::size_t i = 0; i < kCells; ++i) {
    double nearest_seen = -1.0;
    for (std::size_t j = 0; j < kCells; ++j) {
      if (seen_[j]) nearest_seen = std::max(nearest_seen, middles_[i].dot(middles_[j]));
    }
    if (nearest_seen >= worst_cosine) continue;
    worst_cosine = nearest_seen;
    worst = i;
  }
  return middles_[worst];
}

std::string direction_name(const Eigen::Vector3d& direction) {
  // A coordinate counts where it is more than 0.4 of the largest: 22.5 degrees to either side.
  const double limit = 0.4 * direction.cwiseAbs().maxCoeff();
  std::string name;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) <= limit) continue;
    name += direction[axis] < 0.0 ? '-' : '+';
    name += "xyz"[axis];
  }
  return name;
}

}  // namespace vpdr::calibration
