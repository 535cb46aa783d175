#include "pdr/core/heading/straight_stretches.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// So many stretches make directions usual.
constexpr double kLeastStretches = 2.5;
}  // namespace

void StraightStretches::forget() {
  count_ = 0;
  usual_ = 0.0;
  weight_ = 0.0;
}

std::optional<StraightStretch> StraightStretches::take(double yaw_rad) {
  yaws_[count_++] = yaw_rad;
  if (count_ < kSteps) return std::nullopt;
  const std::optional<double> direction = straight_direction();
  if (!direction) {  // the stretch may begin with any of its later steps
    std::shift_left(yaws_.begin(), yaws_.end(), 1);
    --count_;
    return std::nullopt;
  }
  count_ = 0;
  const double agreement = weight_ > 0.0 ? std::abs(usual_) / weight_ : 0.0;
  const double offset = wrap_pi(4.0 * *direction - std::arg(usual_)) / 4.0;
  const bool known = weight_ >= kLeastStretches && agreement >= config_.least_agreement;
  const double sigma = known ? config_.sigma_rad / agreement : config_.sigma_rad;
  const double kept = 1.0 - 1.0 / config_.memory_stretches;
  usual_ = kept * usual_ + std::polar(1.0, 4.0 * *direction);
  weight_ = kept * weight_ + 1.0;
  return StraightStretch{*direction, sigma * sigma,
                         known && std::abs(offset) <= config_.capture_rad};
}

/// Mean direction, unless the steps bend or scatter: by the straight line through them.
std::optional<double> StraightStretches::straight_direction() const {
  const double first = yaws_.front();
  double mean = 0.0;
  for (const double yaw : yaws_) mean += wrap_pi(yaw - first) / kSteps;
  double slope = 0.0;
  double squares = 0.0;
  double time_squares = 0.0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double time = static_cast<double>(i) - 0.5 * (kSteps - 1);
    const double yaw = wrap_pi(yaws_[i] - first) - mean;
    slope += time * yaw;
    squares += yaw * yaw;
    time_squares += time * time;
  }
  slope /= time_squares;
  if (std::abs(slope) * (kSteps - 1) > config_.bend_rad) return std::nullopt;
  if (std::sqrt(squares / kSteps) > config_.scatter_rad) return std::nullopt;
  return wrap_pi(first + mean);
}

}  // namespace vpdr::pdr
