// Position by steps: (11) and S1.3.
#include <algorithm>
#include <cmath>

#include "core/last_step.hpp"
#include "core/square.hpp"
#include "fusion/core/walker_filter.hpp"

namespace vpdr::fusion {

void WalkerFilter::use(const StepEvent& step, FilterState& state) const {
  if (step.status == StepStatus::kWithdrawn) return;
  if (!state.has_heading) {
    take_heading({.stamp_ns = stamp_of(step),
                  .yaw_rad = step.yaw_rad,
                  .yaw_sigma_rad = step.yaw_sigma_rad,
                  .yaw_revision_rad = step.yaw_revision_rad},
                 state);
  } else if (is_correlated()) {
    const double variance =
        square(white_sigma(step.yaw_sigma_rad)) + square(config_.step.direction_sigma_rad);
    // The step was measured before it was known, its zero of yaw is that of a later heading.
    const double yaw = step.yaw_rad + state.revision_rad - step.yaw_revision_rad;
    correct_yaw(yaw, 0.0, variance, state);
  }
  close_walk(step.stamp_ns, state);
  // A tentative step is one with probability p: worth p of its length, and unsure accordingly.
  const double p = step.probability;
  const double length = p * step.length_m * (1.0 + state.x[kScale]);
  const Eigen::Vector2d along(std::cos(state.x[kYaw]), std::sin(state.x[kYaw]));
  const Eigen::Vector2d across(-along.y(), along.x());
  state.x.segment<2>(kX) += length * along;

  StateMatrix f = StateMatrix::Identity();
  f.block<2, 1>(kX, kYaw) = length * across;
  f.block<2, 1>(kX, kScale) = p * step.length_m * along;
  const StateMatrix fp = f * state.p;
  state.p.noalias() = fp * f.transpose();
  const double own_variance =
      std::max(square(step.length_sigma_m) - square(config_.step.scale_sigma * step.length_m), 0.0);
  state.p.block<2, 2>(kX, kX) +=
      (p * own_variance + p * (1.0 - p) * square(step.length_m)) * along * along.transpose() +
      square(length * config_.step.direction_sigma_rad) * across * across.transpose();
  state.steps += step.status == StepStatus::kConfirmed ? 1 : 0;
  state.distance_m += length;
  state.last_step_m = length;
  state.last_step_ns = step.stamp_ns;
  state.last_step_period_s = 1.0 / step.frequency_hz;
  state.last_step_along = along;
}

/// The walk before this step ended short of where its last step led.
void WalkerFilter::close_walk(TimestampNs stamp_ns, FilterState& state) const {
  const double since_s = to_seconds(stamp_ns - state.last_step_ns);
  if (state.last_step_m == 0.0 || !has_halted(since_s, state.last_step_period_s)) return;
  const Eigen::Vector2d last = state.last_step_m * state.last_step_along;
  state.x.segment<2>(kX) -= kHaltShare * last;
  state.p.block<2, 2>(kX, kX) += square(kHaltSigma) * last * last.transpose();
  state.distance_m -= kHaltShare * state.last_step_m;
}

}  // namespace vpdr::fusion
