#include "pdr/core/steps/gait_step_detector.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// How far an interval may be from the walk's own and still go on: a hurried and a drawn-out step.
constexpr double kShortestShare = 0.5;
constexpr double kLongestShare = 1.7;
/// A tentative step is withdrawn after so long: those who listen need not remember more.
constexpr double kPatienceS = 4.5;
/// Period of a first step, of which nothing is known yet.
constexpr double kFirstPeriodS = 0.55;
/// How often in recorded walks the first, second and third peak of a row proved to be steps, those
/// after them that were still in doubt, and those in doubt within a walk.
constexpr std::array<double, 3> kProbability{0.5, 0.7, 0.8};
constexpr double kLateProbability = 0.3;
constexpr double kDoubtProbability = 0.85;
/// The same of a board that is being handled.
constexpr double kHandledProbability = 0.1;
}  // namespace

GaitStepDetector::GaitStepDetector(const StepConfig& config, bool on_trunk)
    : config_(config), on_trunk_(on_trunk), filter_(config), transfer_(config) {
  config_.confirming_steps =
      std::clamp(config_.confirming_steps, 4, static_cast<int>(waiting_.size()));
  config_.confirming_on_trunk =
      std::clamp(config_.confirming_on_trunk, 2, static_cast<int>(waiting_.size()));
}

void GaitStepDetector::restart(StepQueue& steps) {
  withdraw(waiting_count_, steps);
  drop_hint(steps);
  WeightTransfer transfer = transfer_;
  transfer.restart();
  *this = GaitStepDetector(config_, on_trunk_);
  transfer_ = transfer;
}

void GaitStepDetector::add(const SignalValue& value, StepQueue& steps) {
  const double filtered = filter_.filter(value.norm_mps2);
  history_[history_next_] = filtered;
  ups_[history_next_] = value.up;
  rate_radps_ = value.rate_radps;
  history_next_ = (history_next_ + 1) % kHistory;
  history_count_ = std::min(history_count_ + 1, kHistory);
  valley_ = std::min(valley_, filtered);
  crest_ = std::max(crest_, filtered);
  if (history_count_ >= 3 && history(1) >= history(2) && history(1) > history(0)) {
    consider_peak(value, steps);
  }
  if (on_trunk_) consider_transfer(value, steps);
  const auto age_s = [&](TimestampNs stamp_ns) { return to_seconds(value.stamp_ns - stamp_ns); };
  if (waiting_count_ > 0 && age_s(waiting_[0].stamp_ns) > kPatienceS) withdraw(1, steps);
  if (last_peak_ && age_s(*last_peak_) > 2.0 * config_.max_interval_s) {
    end_walk(steps);
    typical_height_ = 0.0;
    typical_swing_ = 0.0;
  }
}

void GaitStepDetector::consider_peak(const SignalValue& value, StepQueue& steps) {
  const double share = on_trunk_ ? 0.0 : config_.threshold_share;
  if (history(1) < std::max(config_.threshold_mps2, share * typical_height_)) return;
  const double shift = parabola_top(history(2), history(1), history(0));
  const double age_s = filter_.delay_s() + StepSignal::kPeriodS * (1.0 - shift);
  const Peak peak{value.stamp_ns - to_ns(age_s), history(1), history(1) - valley_};
  if (too_soon(peak.stamp_ns)) return;
  if (on_trunk_) return consider_bounce(peak, steps);
  accept(peak, steps);
}

/// A step nearer to the one before is the same.
bool GaitStepDetector::too_soon(TimestampNs stamp_ns) const {
  return last_peak_ && to_seconds(stamp_ns - *last_peak_) < config_.min_interval_s;
}

void GaitStepDetector::accept(const Peak& peak, StepQueue& steps) {
  valley_ = history(0);
  crest_ = history(0);
  typical_height_ += 0.25 * (peak.height - typical_height_);
  typical_swing_ += 0.25 * (peak.swing - typical_swing_);
  if (last_peak_ && to_seconds(peak.stamp_ns - *last_peak_) > config_.max_interval_s) {
    end_walk(steps);
  }
  last_peak_ = peak.stamp_ns;
  if (waiting_count_ == waiting_.size()) withdraw(1, steps);
  Peak& latest = waiting_[waiting_count_++];
  latest = peak;
  if (walking_ && goes_on(peak)) return confirm(std::size_t{0}, steps);
  if (walking_ && misses_one(peak)) {
    fill_in(0);
    return confirm(std::size_t{0}, steps);
  }
  if (begins()) {
    // Of a walk that was only in doubt nothing is lost.
    return confirm(walking_ ? 0 : waiting_count_ - confirming(), steps);
  }
  if (begins_by_strides()) {
    withdraw(waiting_count_ - kStrides, steps);
    for (std::size_t i = 1; i < 2 * kStrides - 1; i += 2) fill_in(i);
    return confirm(std::size_t{0}, steps);
  }
  if (walking_ && waiting_count_ == waiting_.size()) return end_walk(steps);
  if (!latest.announced) announce(latest, waiting_count_ - 1, steps);
}

bool GaitStepDetector::goes_on(const Peak& peak) const {
  if (on_trunk_) return bounced() && !handled(kLastingPatience);
  if (given_count_ < 2 || waiting_count_ != 1) return false;
  const auto steps = static_cast<double>(given_count_ - 1);
  const double period_s = to_seconds(given_[0] - given_[given_count_ - 1]) / steps;
  const double interval_s = to_seconds(peak.stamp_ns - given_[0]);
  return interval_s > kShortestShare * period_s && interval_s < kLongestShare * period_s &&
         resemblance(2.0 * period_s) >= config_.lasting_resemblance &&
         tilt_rad(2.0 * period_s) <= config_.lasting_tilt_rad && !handled(kLastingPatience);
}

bool GaitStepDetector::begins() const {
  const std::size_t needed = confirming();
  if (waiting_count_ < needed) return false;
  if (on_trunk_) return bounced() && !handled(1.0);
  double shortest_s = 1e9;
  double longest_s = 0.0;
  for (std::size_t i = waiting_count_ - needed + 2; i < waiting_count_; ++i) {
    const double stride_s = to_seconds(waiting_[i].stamp_ns - waiting_[i - 2].stamp_ns);
    shortest_s = std::min(shortest_s, stride_s);
    longest_s = std::max(longest_s, stride_s);
  }
  const double mean_s = 0.5 * (shortest_s + longest_s);
  return longest_s <= config_.longest_stride_s &&
         longest_s - shortest_s <= config_.evenness * mean_s &&
         resemblance(mean_s) >= config_.resemblance &&
         tilt_rad(mean_s) <= config_.largest_tilt_rad && !handled(1.0);
}

std::optional<double> GaitStepDetector::stride_s() const {
  if (!walking_ || given_count_ < 3) return std::nullopt;
  return to_seconds(given_[0] - given_[2]);
}

double GaitStepDetector::resemblance(double stride_s) const {
  const auto lag = static_cast<std::size_t>(std::lround(stride_s * StepSignal::kRateHz));
  if (history_count_ < 2 * lag) return -1.0;
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < lag; ++i) {
    const double now = history(i);
    const double before = history(i + lag);
    x += now;
    y += before;
    xx += now * now;
    yy += before * before;
    xy += now * before;
  }
  const auto n = static_cast<double>(lag);
  const double product = (xx - x * x / n) * (yy - y * y / n);
  return product > 0.0 ? (xy - x * y / n) / std::sqrt(product) : -1.0;
}

double GaitStepDetector::tilt_rad(double stride_s) const {
  const auto lag = static_cast<std::size_t>(std::lround(stride_s * StepSignal::kRateHz));
  if (history_count_ < 2 * lag) return kPi;
  double least = 1.0;
  for (std::size_t age = 0; age < lag; ++age) {
    least = std::min(least, ups_[place(age)].dot(ups_[place(age + lag)]));
  }
  return std::acos(std::max(least, -1.0));
}

bool GaitStepDetector::handled(double patience) const {
  const double largest =
      patience * (config_.rate_base_radps + config_.rate_per_swing * typical_swing_);
  return rate_radps_ > std::min(largest, config_.largest_rate_radps);
}

/// With so many others that wait before it.
void GaitStepDetector::announce(Peak& peak, std::size_t before, StepQueue& steps) const {
  peak.announced = true;
  DetectedStep step;
  step.stamp_ns = peak.stamp_ns;
  const bool first = before == 0 && given_count_ == 0;
  step.previous_ns = before > 0 ? waiting_[before - 1].stamp_ns : given_[0];
  if (first) step.previous_ns = peak.stamp_ns - to_ns(kFirstPeriodS);
  step.frequency_hz = 1.0 / to_seconds(step.stamp_ns - step.previous_ns);
  step.swing_mps2 = filter_.unfiltered(peak.swing, step.frequency_hz);
  step.status = StepStatus::kTentative;
  step.probability = probability(before);
  steps.push(step);
}

/// Of a peak with so many others waiting before it.
double GaitStepDetector::probability(std::size_t before) const {
  if (handled(1.0)) return kHandledProbability;
  if (walking_) return kDoubtProbability;
  return before < kProbability.size() ? kProbability[before] : kLateProbability;
}

void GaitStepDetector::confirm(std::size_t first, StepQueue& steps) {
  walking_ = true;
  withdraw(first, steps);
  if (given_count_ == 0 && waiting_count_ > 1) {
    // The first step took as long as the second.
    given_[0] = 2 * waiting_[0].stamp_ns - waiting_[1].stamp_ns;
    given_count_ = 1;
  }
  for (std::size_t i = 0; i < waiting_count_; ++i) confirm(waiting_[i], steps);
  waiting_count_ = 0;
}

void GaitStepDetector::confirm(const Peak& peak, StepQueue& steps) {
  DetectedStep step;
  step.stamp_ns = peak.stamp_ns;
  step.previous_ns = given_[0];
  std::shift_right(given_.begin(), given_.end(), 1);
  given_[0] = peak.stamp_ns;
  given_count_ = std::min(given_count_ + 1, given_.size());
  step.frequency_hz = frequency_hz();
  step.swing_mps2 = filter_.unfiltered(peak.swing, step.frequency_hz);
  steps.push(step);
}

/// Over the latest stride, for left and right intervals differ, but not over a halt: a longer
/// interval than the last one is none of a step.
double GaitStepDetector::frequency_hz() const {
  const double latest_s = to_seconds(given_[0] - given_[1]);
  if (given_count_ < 3) return 1.0 / latest_s;
  const double before_s = to_seconds(given_[1] - given_[2]);
  return before_s > kLongestShare * latest_s ? 1.0 / latest_s : 2.0 / (latest_s + before_s);
}

void GaitStepDetector::withdraw(const Peak& peak, StepQueue& steps) {
  if (!peak.announced) return;
  DetectedStep step;
  step.stamp_ns = peak.stamp_ns;
  step.status = StepStatus::kWithdrawn;
  step.probability = 0.0;
  steps.push(step);
}

/// Takes back the oldest peaks that wait.
void GaitStepDetector::withdraw(std::size_t count, StepQueue& steps) {
  for (std::size_t i = 0; i < count; ++i) withdraw(waiting_[i], steps);
  std::shift_left(waiting_.begin(), waiting_.end(), static_cast<std::ptrdiff_t>(count));
  waiting_count_ -= count;
}

void GaitStepDetector::end_walk(StepQueue& steps) {
  walking_ = false;
  withdraw(waiting_count_, steps);
  given_count_ = 0;
}

}  // namespace vpdr::pdr
