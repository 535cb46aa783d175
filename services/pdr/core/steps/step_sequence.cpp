#include "pdr/core/steps/step_sequence.hpp"

#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {

/// A step is heard of up to half a period after its peak; one that is later than this is overdue.
constexpr double kOverduePeriods = 2.0;
/// A board that is handled bounces too: nobody goes on with what is so unlikely a step.
constexpr double kUnlikely = 0.25;

}  // namespace

StepShape StepSequence::shape(const DetectedStep& step, double yaw_rad) const {
  StepShape out;
  out.frequency_hz = step.frequency_hz;
  out.swing_mps2 = step.swing_mps2;
  out.own_turn_rad = turn(step, yaw_rad);
  const bool follows_announced =
      step.status == StepStatus::kTentative && step.previous_ns == pace_.stamp_ns;
  out.sets_off = !out.own_turn_rad && !follows_announced;
  // The pelvis turns forth and back with the two steps of a stride.
  if (out.own_turn_rad) {
    out.turn_rad =
        0.5 * (*out.own_turn_rad + last_->shape.own_turn_rad.value_or(*out.own_turn_rad));
  }
  return out;
}

void StepSequence::take(const DetectedStep& step, const StepShape& shape, double yaw_rad,
                        double length_m) {
  // Steps are confirmed when later ones have been announced.
  if (step.stamp_ns >= pace_.stamp_ns) pace_ = pace_of(step, length_m);
  if (step.status == StepStatus::kConfirmed) last_ = Taken{step, shape, yaw_rad, length_m};
}

void StepSequence::withdraw() { pace_ = last_ ? pace_of(last_->step, last_->length_m) : Pace{}; }

StepSequence::Pace StepSequence::pace_of(const DetectedStep& step, double length_m) {
  const bool unlikely = step.probability < kUnlikely;
  return {step.stamp_ns, 1.0 / step.frequency_hz, unlikely ? 0.0 : length_m * step.frequency_hz};
}

double StepSequence::speed_mps(TimestampNs stamp_ns) const {
  const double since = to_seconds(stamp_ns - pace_.stamp_ns);
  return since < kOverduePeriods * pace_.period_s ? pace_.speed_mps : 0.0;
}

/// None of a step that begins a walk.
std::optional<double> StepSequence::turn(const DetectedStep& step, double yaw_rad) const {
  if (!last_ || step.previous_ns != last_->step.stamp_ns) return std::nullopt;
  return wrap_pi(yaw_rad - last_->yaw_rad);
}

}  // namespace vpdr::pdr
