#include "pdr/core/steps/peak_step_detector.hpp"

#include <algorithm>

namespace vpdr::pdr {

void PeakStepDetector::add(const SignalValue& value, StepQueue& steps) {
  last_ = {filter_.filter(value.norm_mps2), last_[0], last_[1]};
  valley_ = std::min(valley_, last_[0]);
  if (last_step_ && to_seconds(value.stamp_ns - *last_step_) > config_.max_interval_s) {
    walking_ = false;
  }
  const bool is_peak = last_[1] >= last_[2] && last_[1] > last_[0];
  if (!is_peak || last_[1] < config_.threshold_mps2) return;
  const double shift = parabola_top(last_[2], last_[1], last_[0]);
  DetectedStep step;
  step.stamp_ns = value.stamp_ns - to_ns(filter_.delay_s() + StepSignal::kPeriodS * (1.0 - shift));
  const double interval_s = last_step_ ? to_seconds(step.stamp_ns - *last_step_) : 1e9;
  if (interval_s < config_.min_interval_s) return;
  const double period_s = std::min(interval_s, config_.max_interval_s);
  step.previous_ns = step.stamp_ns - to_ns(period_s);
  step.frequency_hz = 1.0 / period_s;
  step.swing_mps2 = filter_.unfiltered(last_[1] - valley_, step.frequency_hz);
  steps.push(step);
  last_step_ = step.stamp_ns;
  valley_ = last_[0];
  walking_ = true;
}

}  // namespace vpdr::pdr
