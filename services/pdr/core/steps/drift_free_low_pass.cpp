#include "pdr/core/steps/drift_free_low_pass.hpp"

#include <algorithm>

#include "pdr/core/steps/step_signal.hpp"

namespace vpdr::pdr {

namespace {
/// Steps per second of an ordinary walk.
constexpr double kWalkHz = 1.8;
/// What a filter took more of is not taken back.
constexpr double kLeastGain = 0.5;
}  // namespace

DriftFreeLowPass::DriftFreeLowPass(const StepConfig& config)
    : drift_time_s_(config.drift_time_s),
      low_pass_(config.filter_order, config.cutoff_hz, StepSignal::kRateHz),
      delay_s_(low_pass_.delay_s(kWalkHz)) {}

double DriftFreeLowPass::filter(double norm_mps2) {
  mean_age_s_ += StepSignal::kPeriodS;
  const double share = StepSignal::kPeriodS / std::min(mean_age_s_, drift_time_s_);
  mean_ += std::min(1.0, share) * (norm_mps2 - mean_);
  return low_pass_.filter(norm_mps2 - mean_);
}

double DriftFreeLowPass::unfiltered(double swing_mps2, double frequency_hz) const {
  return swing_mps2 / std::max(low_pass_.gain(frequency_hz), kLeastGain);
}

double parabola_top(double before, double middle, double after) {
  const double curvature = before - 2.0 * middle + after;
  return curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
}

}  // namespace vpdr::pdr
