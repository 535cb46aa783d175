#include "pdr/core/steps/tentative_steps.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {
Eigen::Vector2d along(const StepEvent& step, double revision_rad) {
  const double yaw = step.yaw_rad + revision_rad - step.yaw_revision_rad;
  return {std::cos(yaw), std::sin(yaw)};
}
}  // namespace

void TentativeSteps::add(const StepEvent& step) {
  if (count_ == steps_.size()) {
    std::shift_left(steps_.begin(), steps_.end(), 1);
    --count_;
  }
  steps_[count_++] = step;
}

std::optional<StepEvent> TentativeSteps::take(TimestampNs stamp_ns) {
  const auto end = steps_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::find_if(
      steps_.begin(), end, [stamp_ns](const StepEvent& step) { return step.stamp_ns == stamp_ns; });
  if (found == end) return std::nullopt;
  const StepEvent step = *found;
  std::shift_left(found, end, 1);
  --count_;
  return step;
}

Eigen::Vector2d TentativeSteps::displacement_m(double revision_rad) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    sum += steps_[i].probability * steps_[i].length_m * along(steps_[i], revision_rad);
  }
  return sum;
}

Eigen::Matrix2d TentativeSteps::covariance_m2(double revision_rad) const {
  // They are all steps of one walk or none is: their errors add up.
  Eigen::Vector2d doubt = Eigen::Vector2d::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const StepEvent& step = steps_[i];
    const double p = step.probability;
    const Eigen::Vector2d direction = along(step, revision_rad);
    doubt += std::sqrt(p * (1.0 - p)) * step.length_m * direction;
    noise += p * step.length_sigma_m * step.length_sigma_m * direction * direction.transpose();
  }
  return doubt * doubt.transpose() + noise;
}

}  // namespace vpdr::pdr
