#include "pdr/core/attitude/complementary_filter.hpp"

#include <algorithm>

#include "core/rotation.hpp"

namespace vpdr::pdr {

void ComplementaryFilter::step(const Eigen::Vector3d& rate_radps,
                               const Eigen::Quaterniond& measured, double dt_s) {
  const Eigen::Vector3d error = log_rotation(world_from_body_.conjugate() * measured);
  const double share = std::min(1.0, dt_s / config_.time_constant_s);
  world_from_body_ = first_order_step(world_from_body_, rate_radps * dt_s + share * error);
}

Eigen::Matrix3d ComplementaryFilter::covariance_rad2() const {
  const double level = config_.level_sigma_rad * config_.level_sigma_rad;
  const double heading = config_.heading_sigma_rad * config_.heading_sigma_rad;
  return Eigen::Vector3d(level, level, heading).asDiagonal();
}

Eigen::Quaterniond first_order_step(const Eigen::Quaterniond& q, const Eigen::Vector3d& angle_rad) {
  const Eigen::Quaterniond rate(0.0, angle_rad.x(), angle_rad.y(), angle_rad.z());
  const Eigen::Quaterniond slope = q * rate;
  return Eigen::Quaterniond(q.coeffs() + 0.5 * slope.coeffs()).normalized();
}

}  // namespace vpdr::pdr
