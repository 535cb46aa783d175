#pragma once
// What a board has that was never calibrated, and how it shows. A filter trusts a board to be
// calibrated; what it then finds in it may be more than that trust allows. SI, microtesla.
#include <Eigen/Core>
#include <Eigen/LU>

namespace vpdr::pdr {

/// Of each axis.
inline constexpr double kUncalibratedIron_ut = 40.0;
inline constexpr double kUncalibratedBias_radps = 0.05;
/// Normalised square (3 dof) that no calibrated board has.
inline constexpr double kSurprise = 16.0;

/// Normalised square of what was found, of which the variance `prior` of each axis was trusted and
/// `left` is still open: of all that the prior left open and the measurements closed, and of a
/// twentieth of it where they closed nothing.
[[nodiscard]] inline double surprise_of(const Eigen::Vector3d& found, double prior,
                                        const Eigen::Matrix3d& left) {
  constexpr double kUnfound = 0.05;
  const Eigen::Matrix3d closed = (1.0 + kUnfound) * prior * Eigen::Matrix3d::Identity() - left;
  return found.dot(closed.inverse() * found);
}

}  // namespace vpdr::pdr
