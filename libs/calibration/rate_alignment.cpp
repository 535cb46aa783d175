#include "calibration/rate_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::calibration {
namespace {

/// Below this share of the largest, an eigenvalue of the normal equations is no knowledge.
constexpr double kLeastEigenvalue = 1e-6;

}  // namespace

void RateAlignment::add(const Eigen::Vector3d& turn_rad, const Eigen::Vector3d& before,
                        const Eigen::Vector3d& after, double sigma) {
  // -(G t) x d = [d]x G t, and G t = (t^T (x) I) vec(G), columns of G below one another.
  const Eigen::Matrix3d cross = skew(0.5 * (before + after));
  Eigen::Matrix<double, 3, 9> rows;
  for (int column = 0; column < 3; ++column) {
    rows.middleCols<3>(Eigen::Index{3} * column) = turn_rad[column] * cross;
  }
  const Eigen::Vector3d change = after - before;
  const double precision = 1.0 / (sigma * sigma);
  normal_.noalias() += precision * rows.transpose() * rows;
  right_.noalias() += precision * rows.transpose() * change;
  squares_ += precision * change.squaredNorm();
  ++turns_;
}

std::optional<RateAlignment::Solution> RateAlignment::solve() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(normal_);
  const auto& values = eigen.eigenvalues();
  if (values[8] <= 0.0 || values[0] < kLeastEigenvalue * values[8]) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> solution =
      eigen.eigenvectors() * (eigen.eigenvectors().transpose() * right_).cwiseQuotient(values);
  Solution out;
  out.direction_from_gyro = Eigen::Map<const Eigen::Matrix3d>(solution.data());
  // Each turn has two errors that count: the direction's length is fixed.
  const double left_over = std::max(0.0, squares_ - solution.dot(right_));
  out.misfit = std::sqrt(left_over / std::max(1.0, 2.0 * static_cast<double>(turns_) - 9.0));
  out.worst_sigma = out.misfit / std::sqrt(values[0]);
  return out;
}

}  // namespace vpdr::calibration
