// Steps of a board on waist, chest or head: bounces, and the weight that goes from leg to leg.
#include <algorithm>
#include <cmath>
#include <utility>

#include "pdr/core/gait_step_detector.hpp"

namespace vpdr::pdr {

namespace {
/// A bounce and the weight's going over so near to each other are of one step, s.
constexpr double kTogetherS = 0.3;
/// So long after either the other has been seen if there is one, and the next bounce of an ordinary
/// walk as well, s: half of kStepApartS and what the filters take.
constexpr double kHintPatienceS = 0.65;
/// Between two bounces no further apart than this, and than the two before by so much, is no step.
constexpr double kStepApartS = 0.9;
constexpr double kEvenShare = 1.3;
}  // namespace

/// Of bounces. True if a step took as long as the one before, so that there is none between.
bool GaitStepDetector::take_interval(TimestampNs stamp_ns) {
  const auto before_ns = std::exchange(last_bounce_, stamp_ns);
  if (!before_ns) return false;
  const double interval_s = to_seconds(stamp_ns - *before_ns);
  transfer_.learn(interval_s);
  const double before_s = std::exchange(bounce_interval_s_, interval_s);
  return interval_s < std::min(kStepApartS, kEvenShare * before_s);
}

/// A firm bounce is a step, and has the middle of the two instants if the weight went over before
/// it. A weak one looks like what one does with one's arms: where the weight is seen to go from leg
/// to leg, it waits for that.
void GaitStepDetector::consider_bounce(const Peak& peak, StepQueue& steps) {
  const bool one_step_apart = take_interval(peak.stamp_ns);
  if (transfer_.axis() && peak.height < config_.firm_mps2) {
    if (!with_hint(peak.stamp_ns)) wait_for_more({peak, false}, steps);
    return;
  }
  Peak firm = peak;
  if (with_hint(peak.stamp_ns)) {
    const TimestampNs lead_ns = peak.stamp_ns - hint_->peak.stamp_ns;
    if (hint_->transfer && !too_soon(peak.stamp_ns - lead_ns / 2)) firm.stamp_ns -= lead_ns / 2;
    drop_hint(steps);
  } else if (one_step_apart && hint_ && hint_->transfer) {
    drop_hint(steps);
  }
  settle_hint(steps);
  if (!too_soon(firm.stamp_ns)) accept(firm, steps);
}

void GaitStepDetector::consider_transfer(const SignalValue& value, StepQueue& steps) {
  if (const auto stamp_ns = transfer_.add(value)) {
    last_transfer_ = *stamp_ns;
    take_transfer(*stamp_ns, steps);
  }
  if (!hint_) return;
  if (to_seconds(value.stamp_ns - hint_->peak.stamp_ns) > kHintPatienceS) settle_hint(steps);
}

void GaitStepDetector::take_transfer(TimestampNs stamp_ns, StepQueue& steps) {
  Peak peak{stamp_ns, crest_, crest_ - valley_};
  if (with_hint(stamp_ns)) {
    if (hint_->transfer) return;
    // It tells the instant of a weak bounce better than the bounce.
    peak.height = hint_->peak.height;
    peak.swing = hint_->peak.swing;
    drop_hint(steps);
  }
  if (!too_soon(stamp_ns)) wait_for_more({peak, true}, steps);
}

void GaitStepDetector::wait_for_more(const Hint& hint, StepQueue& steps) {
  settle_hint(steps);
  hint_ = hint;
  announce(hint_->peak, waiting_count_, steps);
}

/// Nothing more came: the weight's going over is a step by itself, a weak bounce only of who is not
/// seen to go from leg to leg at the time.
void GaitStepDetector::settle_hint(StepQueue& steps) {
  if (!hint_) return;
  const auto [peak, transfer] = *hint_;
  hint_.reset();
  const bool seen = last_transfer_ &&
                    std::abs(to_seconds(peak.stamp_ns - *last_transfer_)) < config_.max_interval_s;
  if (too_soon(peak.stamp_ns) || (seen && !transfer)) return withdraw(peak, steps);
  accept(peak, steps);
}

void GaitStepDetector::drop_hint(StepQueue& steps) {
  if (hint_) withdraw(hint_->peak, steps);
  hint_.reset();
}

bool GaitStepDetector::with_hint(TimestampNs stamp_ns) const {
  return hint_ && std::abs(to_seconds(stamp_ns - hint_->peak.stamp_ns)) < kTogetherS;
}

/// Whoever walks bounces now and then; who only sways from leg to leg stands.
bool GaitStepDetector::bounced() const {
  return last_bounce_ && to_seconds(*last_peak_ - *last_bounce_) < 2.0 * config_.max_interval_s;
}

}  // namespace vpdr::pdr
