// The end of RelativeMotionEstimator's search: from a good hypothesis to the best one, with its
// covariance.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/rotation.hpp"
#include "vision/core/odometry/coplanarity.hpp"
#include "vision/core/odometry/relative_motion.hpp"

namespace vpdr::vision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Gauss-Newton over rotation and direction, points weighted by Cauchy's function.
void RelativeMotionEstimator::refine(Hypothesis& h, const std::optional<RotationPrior>& prior,
                                     RelativeMotion* out) const {
  Eigen::Matrix<double, 5, 5> information;
  Eigen::Matrix<double, 3, 2> basis;
  for (int step = 0; step < config_.refinements; ++step) {
    basis = across(h.direction);
    information.setZero();
    Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
    for (const RayPair& p : *pairs_) {
      const Coplanarity c = coplanarity(p, h.rotation, h.direction, sigma_rad_);
      Eigen::Matrix<double, 1, 5> jacobian;
      jacobian << c.by_rotation, c.by_direction * basis;
      const double weight = 1.0 / (1.0 + c.value * c.value / config_.inlier_sigmas);
      information += weight * jacobian.transpose() * jacobian;
      gradient += weight * c.value * jacobian.transpose();
    }
    if (prior) {
      const Vector3d off = log_rotation(
          Eigen::Quaterniond(h.rotation * prior->earlier_from_later.transpose()).normalized());
      const double weight = 1.0 / (prior->sigma_rad * prior->sigma_rad);
      information.topLeftCorner<3, 3>() += weight * Matrix3d::Identity();
      gradient.head<3>() += weight * off;
    }
    information.diagonal().array() += 1e-3;
    const Eigen::Matrix<double, 5, 1> change = information.ldlt().solve(-gradient);
    if (!change.allFinite()) break;
    h.rotation = exp_rotation(change.head<3>()).toRotationMatrix() * h.rotation;
    h.direction = (h.direction + basis * change.tail<2>()).normalized();
    if (change.norm() < 1e-7) break;
  }
  if (out == nullptr) return;
  const Eigen::Matrix<double, 5, 5> covariance = information.inverse();
  Eigen::Matrix<double, 6, 5> spread = Eigen::Matrix<double, 6, 5>::Zero();
  spread.topLeftCorner<3, 3>().setIdentity();
  spread.bottomRightCorner<3, 2>() = basis;
  out->covariance = spread * covariance * spread.transpose();
}

void RelativeMotionEstimator::refine_rotation(Hypothesis& h,
                                              const std::optional<RotationPrior>& prior,
                                              RelativeMotion* out) const {
  Matrix3d information = Matrix3d::Identity();
  const double scale = 1.0 / (2.0 * sigma_rad_ * sigma_rad_);
  for (int step = 0; step < config_.refinements; ++step) {
    information = 1e-3 * Matrix3d::Identity();
    Vector3d gradient = Vector3d::Zero();
    for (const RayPair& p : *pairs_) {
      const Vector3d later = h.rotation * p.later;
      const Vector3d off = later - p.earlier;
      const double weight = scale / (1.0 + off.squaredNorm() * scale / config_.inlier_sigmas);
      information += weight * (Matrix3d::Identity() - later * later.transpose());
      gradient += weight * later.cross(off);
    }
    if (prior) {
      const Vector3d off = log_rotation(
          Eigen::Quaterniond(h.rotation * prior->earlier_from_later.transpose()).normalized());
      const double weight = 1.0 / (prior->sigma_rad * prior->sigma_rad);
      information += weight * Matrix3d::Identity();
      gradient += weight * off;
    }
    const Vector3d change = information.ldlt().solve(-gradient);
    h.rotation = exp_rotation(change).toRotationMatrix() * h.rotation;
    if (change.norm() < 1e-8) break;
  }
  if (out != nullptr) out->covariance.topLeftCorner<3, 3>() = information.inverse();
}

}  // namespace vpdr::vision
