#include "pdr/core/attitude/horizon_base.hpp"

#include <algorithm>

#include "core/samples.hpp"
#include "core/square.hpp"

namespace vpdr::pdr {

namespace {
/// Readings at the accelerometer's limit look like an offset that is larger than any: variance, in
/// those of the prior, that is believed at most.
constexpr double kLargest = 2.0;
}  // namespace

void HorizonBase::add(double up_velocity_mps, double duration_s) {
  weight_s_ = std::min(weight_s_ + duration_s, config_.memory_s);
  const double surplus_mps = up_velocity_mps - kGravityMps2 * duration_s;
  surplus_mps2_ += (surplus_mps - duration_s * surplus_mps2_) / weight_s_;
}

double HorizonBase::variance_rad2() const {
  const double prior = square(config_.sigma_rad);
  const double seen = square(surplus_mps2_ / kGravityMps2);
  const double kept = config_.kept_share;
  const double learned = std::min((seen + kept * prior) / (1.0 + kept), kLargest * prior);
  return prior + weight_s_ / config_.memory_s * (learned - prior);
}

}  // namespace vpdr::pdr
