#include "pdr/core/step_detector.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {
constexpr double kGridHz = 50.0;
constexpr double kGridS = 0.02;
/// Frequency at which the filter's delay is taken: an ordinary walk.
constexpr double kWalkHz = 1.8;
/// Time over which the r.m.s. rate is taken, s.
constexpr double kRateMemory = 1.0;
/// How far an interval may be from the walk's own and still go on: a hurried and a drawn-out step.
constexpr double kShortestShare = 0.5;
constexpr double kLongestShare = 1.7;
}  // namespace

StepDetector::StepDetector(const StepConfig& config)
    : config_(config), low_pass_(config.filter_order, config.cutoff_hz, kGridHz) {
  config_.confirming_steps =
      std::clamp(config_.confirming_steps, 4, static_cast<int>(waiting_.size()));
}

void StepDetector::add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
                       const Eigen::Vector3d& angular_velocity_radps) {
  const double norm = specific_force_mps2.norm();
  const double span = to_seconds(stamp_ns - last_stamp_);
  if (!started_ || span <= 0.0 || span > config_.gap_s) {
    restart(stamp_ns, norm);
    return;
  }
  rate_variance_ +=
      std::min(1.0, span / kRateMemory) * (angular_velocity_radps.squaredNorm() - rate_variance_);
  // Mean of the straight line between samples over each grid cell: interpolates slow streams and
  // averages fast ones.
  TimestampNs from = last_stamp_;
  double value = last_norm_;
  while (from < stamp_ns) {
    const TimestampNs to = std::min(stamp_ns, next_grid_);
    const double end = last_norm_ + to_seconds(to - last_stamp_) / span * (norm - last_norm_);
    const double dt = to_seconds(to - from);
    cell_sum_ += 0.5 * (value + end) * dt;
    cell_s_ += dt;
    from = to;
    value = end;
    if (to != next_grid_) continue;
    add_grid_value(next_grid_ - kGridNs / 2, cell_sum_ / cell_s_);
    cell_sum_ = 0.0;
    cell_s_ = 0.0;
    next_grid_ += kGridNs;
  }
  last_stamp_ = stamp_ns;
  last_norm_ = norm;
}

std::optional<DetectedStep> StepDetector::take() {
  if (queue_count_ == 0) return std::nullopt;
  const DetectedStep step = queue_[queue_begin_];
  queue_begin_ = (queue_begin_ + 1) % kQueue;
  --queue_count_;
  return step;
}

void StepDetector::restart(TimestampNs stamp_ns, double norm) {
  started_ = true;
  last_stamp_ = stamp_ns;
  last_norm_ = norm;
  next_grid_ = stamp_ns + kGridNs;
  cell_sum_ = 0.0;
  cell_s_ = 0.0;
  low_pass_ = ButterworthLowPass(config_.filter_order, config_.cutoff_hz, kGridHz);
  mean_age_s_ = 0.0;
  rate_variance_ = 0.0;
  history_count_ = 0;
  typical_height_ = 0.0;
  end_walk();
}

void StepDetector::add_grid_value(TimestampNs stamp_ns, double norm) {
  mean_age_s_ += kGridS;
  mean_ += std::max(kGridS / mean_age_s_, kGridS / config_.drift_time_s) * (norm - mean_);
  const double value = low_pass_.filter(norm - mean_);
  history_[history_next_] = value;
  history_next_ = (history_next_ + 1) % kHistory;
  history_count_ = std::min(history_count_ + 1, kHistory);
  valley_ = std::min(valley_, value);
  if (history_count_ < 3) return;
  if (history(1) >= history(2) && history(1) > history(0)) consider_peak(stamp_ns);
  if (last_peak_ && to_seconds(stamp_ns - *last_peak_) > 2.0 * config_.max_interval_s) {
    end_walk();
    typical_height_ = 0.0;
  }
}

void StepDetector::consider_peak(TimestampNs stamp_ns) {
  const double threshold =
      std::max(config_.threshold_mps2, config_.threshold_share * typical_height_);
  if (history(1) < threshold) return;
  // Top of the parabola through the three values.
  const double curvature = history(2) - 2.0 * history(1) + history(0);
  const double shift = curvature < 0.0 ? 0.5 * (history(2) - history(0)) / curvature : 0.0;
  const double age_s = low_pass_.delay_s(kWalkHz) + kGridS * (1.0 - shift);
  const Peak peak{stamp_ns - to_ns(age_s), history(1), history(1) - valley_};
  if (last_peak_ && to_seconds(peak.stamp_ns - *last_peak_) < config_.min_interval_s) return;
  valley_ = history(0);
  if (rate_variance_ > config_.largest_rate_radps * config_.largest_rate_radps) {
    end_walk();
    return;
  }
  accept(peak);
}

void StepDetector::accept(const Peak& peak) {
  typical_height_ += 0.25 * (peak.height - typical_height_);
  if (last_peak_ && to_seconds(peak.stamp_ns - *last_peak_) > config_.max_interval_s) end_walk();
  last_peak_ = peak.stamp_ns;
  if (waiting_count_ == waiting_.size()) {
    std::shift_left(waiting_.begin(), waiting_.end(), 1);
    --waiting_count_;
  }
  waiting_[waiting_count_++] = peak;
  if (walking_ && goes_on(peak)) {
    confirm(0);
  } else if (begins()) {
    // Of a walk that was only in doubt nothing is lost.
    confirm(walking_ ? 0 : waiting_count_ - static_cast<std::size_t>(config_.confirming_steps));
  } else if (walking_ && waiting_count_ == waiting_.size()) {
    end_walk();
  }
}

bool StepDetector::goes_on(const Peak& peak) const {
  if (given_count_ < 2 || waiting_count_ != 1) return false;
  const auto steps = static_cast<double>(given_count_ - 1);
  const double period = to_seconds(given_[0] - given_[given_count_ - 1]) / steps;
  const double interval = to_seconds(peak.stamp_ns - given_[0]);
  return interval > kShortestShare * period && interval < kLongestShare * period &&
         resemblance(2.0 * period) >= config_.lasting_resemblance;
}

bool StepDetector::begins() const {
  const auto needed = static_cast<std::size_t>(config_.confirming_steps);
  if (waiting_count_ < needed) return false;
  double shortest = 1e9;
  double longest = 0.0;
  for (std::size_t i = waiting_count_ - needed + 2; i < waiting_count_; ++i) {
    const double stride = to_seconds(waiting_[i].stamp_ns - waiting_[i - 2].stamp_ns);
    shortest = std::min(shortest, stride);
    longest = std::max(longest, stride);
  }
  const double mean = 0.5 * (shortest + longest);
  return longest <= config_.longest_stride_s && longest - shortest <= config_.evenness * mean &&
         resemblance(mean) >= config_.resemblance;
}

double StepDetector::resemblance(double stride_s) const {
  const auto lag = static_cast<std::size_t>(std::lround(stride_s * kGridHz));
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

void StepDetector::confirm(std::size_t first) {
  walking_ = true;
  if (given_count_ == 0 && first + 1 < waiting_count_) {
    // The first step took as long as the second.
    given_[0] = 2 * waiting_[first].stamp_ns - waiting_[first + 1].stamp_ns;
    given_count_ = 1;
  }
  for (std::size_t i = first; i < waiting_count_; ++i) emit(waiting_[i]);
  waiting_count_ = 0;
}

void StepDetector::emit(const Peak& peak) {
  DetectedStep step;
  step.stamp_ns = peak.stamp_ns;
  step.previous_ns = given_[0];
  std::shift_right(given_.begin(), given_.end(), 1);
  given_[0] = peak.stamp_ns;
  given_count_ = std::min(given_count_ + 1, given_.size());
  // Over whole strides: left and right intervals differ.
  const std::size_t steps = given_count_ - 1 - (given_count_ > 2 ? (given_count_ - 1) % 2 : 0);
  step.frequency_hz = static_cast<double>(steps) / to_seconds(given_[0] - given_[steps]);
  step.swing_mps2 = peak.swing;
  if (queue_count_ == kQueue) return;  // sixteen untaken steps: nobody listens
  queue_[(queue_begin_ + queue_count_) % kQueue] = step;
  ++queue_count_;
}

void StepDetector::end_walk() {
  walking_ = false;
  waiting_count_ = 0;
  given_count_ = 0;
}

}  // namespace vpdr::pdr
