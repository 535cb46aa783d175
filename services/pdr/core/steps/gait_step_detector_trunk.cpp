// Steps of a board on waist, chest or head: bounces, and the weight that goes from leg to leg.
#include <algorithm>
#include <cmath>
#include <utility>

#include "pdr/core/steps/gait_step_detector.hpp"

namespace vpdr::pdr {

namespace {
/// A bounce and the weight's going over so near to each other are of one step, s.
constexpr double kTogetherS = 0.3;
/// So long after either the other has been seen if there is one, and the next bounce of an ordinary
/// walk as well, s: half of kStepApartS and what the filters take.
constexpr double kHintPatienceS = 0.65;
/// Between two bounces no further apart than this, and than the two before by so much, is no step.
constexpr double kStepApartS = 0.9;
constexpr double kLongestShare = 1.3;
}  // namespace

/// Of bounces, against the one before.
GaitStepDetector::Rhythm GaitStepDetector::take_interval(TimestampNs stamp_ns) {
  const auto before_ns = std::exchange(last_bounce_, stamp_ns);
  if (!before_ns) return {};
  const double interval_s = to_seconds(stamp_ns - *before_ns);
  transfer_.learn(interval_s);
  const double before_s = std::exchange(bounce_interval_s_, interval_s);
  if (interval_s > std::min(kStepApartS, kLongestShare * before_s)) return {};
  return std::abs(interval_s - before_s) < config_.evenness * before_s ? Rhythm::kEven
                                                                       : Rhythm::kOneStep;
}

/// A firm bounce is a step. Where steps are uneven and the weight went over before it, the step is
/// in the middle of the two instants. A weak bounce looks like what one does with one's arms: where
/// the weight is seen to go from leg to leg, it waits for that.
void GaitStepDetector::consider_bounce(const Peak& peak, StepQueue& steps) {
  const Rhythm rhythm = take_interval(peak.stamp_ns);
  if (transfer_.axis() && peak.height < config_.firm_mps2) {
    if (!with_hint(peak.stamp_ns)) wait_for_more({peak, false}, steps);
    return;
  }
  Peak firm = peak;
  if (with_hint(peak.stamp_ns)) {
    const TimestampNs middle_ns = peak.stamp_ns - (peak.stamp_ns - hint_->peak.stamp_ns) / 2;
    const bool tells = hint_->transfer && rhythm != Rhythm::kEven && !too_soon(middle_ns);
    if (tells) firm.stamp_ns = middle_ns;
    drop_hint(steps);
  } else if (rhythm != Rhythm::kNone && hint_ && hint_->transfer) {
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
  // The one before, told late, may have been this step or a later one.
  if (too_soon(hint.peak.stamp_ns)) return;
  // Who listens remembers no more of them than wait here.
  if (waiting_count_ == waiting_.size()) withdraw(1, steps);
  hint_ = hint;
  announce(hint_->peak, waiting_count_, steps);
}

/// Nothing more came: the weight's going over is a step by itself, a weak bounce only where no leg
/// is seen to carry alone on both sides of it; the step that closes a walk brings the weight
/// between the feet.
void GaitStepDetector::settle_hint(StepQueue& steps) {
  if (!hint_) return;
  const auto [peak, transfer] = *hint_;
  hint_.reset();
  if (too_soon(peak.stamp_ns) || (!transfer && on_one_leg(peak.stamp_ns))) {
    return withdraw(peak, steps);
  }
  accept(peak, steps);
}

bool GaitStepDetector::on_one_leg(TimestampNs stamp_ns) const {
  if (!last_transfer_ || to_seconds(stamp_ns - *last_transfer_) > config_.max_interval_s)
    return false;
  return to_seconds(transfer_.one_leg_until_ns() - stamp_ns) > kTogetherS;
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
