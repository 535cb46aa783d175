#include "pdr/core/attitude/coarse_levelling.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::pdr {

Eigen::Quaterniond CoarseLevelling::add(const Eigen::Vector3d& velocity_mps, double duration_s) {
  duration_s_ += duration_s;
  sum_mps_ += velocity_mps;
  square_sum_ += velocity_mps.squaredNorm() / duration_s;
  if (!(sum_mps_.norm() > 0.0)) return Eigen::Quaterniond::Identity();
  Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(sum_mps_, Eigen::Vector3d::UnitZ());
  sum_mps_ = upright * sum_mps_;
  return upright;
}

double CoarseLevelling::tilt_sigma_rad() const {
  if (!(duration_s_ > 0.0)) return kPi;
  const double mean_square = square_sum_ / duration_s_;
  const double variance = mean_square - (sum_mps_ / duration_s_).squaredNorm();
  return std::sqrt(std::max(variance, 0.0) / 3.0) / kGravityMps2;
}

}  // namespace vpdr::pdr
