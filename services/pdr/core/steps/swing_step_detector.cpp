#include "pdr/core/steps/swing_step_detector.hpp"

#include <algorithm>
#include <numeric>

namespace vpdr::pdr {

void SwingStepDetector::add(const SignalValue& value, StepQueue& steps) {
  recent_[seen_++ % kMean] = value.norm_mps2;
  if (seen_ < kMean) return;
  const double norm = std::accumulate(recent_.begin(), recent_.end(), 0.0) / kMean;
  const TimestampNs middle_ns = value.stamp_ns - to_ns(0.5 * (kMean - 1) * StepSignal::kPeriodS);
  if (last_step_ && to_seconds(middle_ns - *last_step_) > config_.max_interval_s) walking_ = false;
  if (seen_ == kMean) minimum_ = maximum_ = norm;
  if (rising_) {
    rise(middle_ns, norm, steps);
  } else {
    fall(norm);
  }
}

void SwingStepDetector::rise(TimestampNs stamp_ns, double norm, StepQueue& steps) {
  if (norm > maximum_) {
    maximum_ = norm;
    maximum_ns_ = stamp_ns;
  }
  if (maximum_ - norm <= config_.swing_threshold_mps2) return;
  if (maximum_ - minimum_ > config_.swing_threshold_mps2) take_step(steps);
  rising_ = false;
  minimum_ = norm;
}

void SwingStepDetector::fall(double norm) {
  minimum_ = std::min(minimum_, norm);
  if (norm - minimum_ <= config_.swing_threshold_mps2) return;
  rising_ = true;
  maximum_ = norm;
}

void SwingStepDetector::take_step(StepQueue& steps) {
  const double interval_s = last_step_ ? to_seconds(maximum_ns_ - *last_step_) : 1e9;
  if (interval_s < config_.min_interval_s) return;
  const double period_s = std::min(interval_s, config_.max_interval_s);
  DetectedStep step;
  step.stamp_ns = maximum_ns_;
  step.previous_ns = maximum_ns_ - to_ns(period_s);
  step.frequency_hz = 1.0 / period_s;
  step.swing_mps2 = maximum_ - minimum_;
  steps.push(step);
  last_step_ = maximum_ns_;
  walking_ = true;
}

}  // namespace vpdr::pdr
