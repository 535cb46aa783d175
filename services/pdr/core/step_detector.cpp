#include "pdr/core/step_detector.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {
/// Frequency at which the filter's delay is taken: an ordinary walk.
constexpr double kWalkHz = 1.8;
}  // namespace

StepDetector::StepDetector(const StepConfig& config)
    : config_(config), low_pass_(config.filter_order, config.cutoff_hz, kGridHz) {
  config_.confirming_steps =
      std::clamp(config_.confirming_steps, 1, static_cast<int>(waiting_.size()));
}

void StepDetector::add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2) {
  const double norm = specific_force_mps2.norm();
  if (!started_ || to_seconds(stamp_ns - last_stamp_) > config_.gap_s) {
    restart(stamp_ns, norm);
    return;
  }
  // Mean of the straight line between samples over each grid cell: interpolates slow streams and
  // averages fast ones.
  TimestampNs from = last_stamp_;
  double value = last_norm_;
  const double span = to_seconds(stamp_ns - last_stamp_);
  while (from < stamp_ns) {
    const TimestampNs to = std::min(stamp_ns, next_grid_);
    const double share = to_seconds(to - last_stamp_) / span;
    const double end = last_norm_ + share * (norm - last_norm_);
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
  recent_count_ = 0;
  waiting_count_ = 0;
  has_last_ = false;
  walking_ = false;
  typical_height_ = 0.0;
}

void StepDetector::add_grid_value(TimestampNs stamp_ns, double norm) {
  const double dt = 1.0 / kGridHz;
  mean_age_s_ += dt;
  mean_ += std::max(dt / mean_age_s_, dt / config_.drift_time_s) * (norm - mean_);
  const double value = low_pass_.filter(norm - mean_);
  recent_ = {recent_[1], recent_[2], value};
  valley_ = std::min(valley_, value);
  if (++recent_count_ < 3) return;
  if (recent_[1] >= recent_[0] && recent_[1] > recent_[2]) {
    const double curvature = recent_[0] - 2.0 * recent_[1] + recent_[2];
    const double shift = curvature < 0.0 ? 0.5 * (recent_[0] - recent_[2]) / curvature : 0.0;
    const double delay_s = low_pass_.delay_s(kWalkHz) + dt * (1.0 - shift);
    consider_peak({stamp_ns - to_ns(delay_s), recent_[1], recent_[1] - valley_});
  }
  if (has_last_ && to_seconds(stamp_ns - last_peak_.stamp_ns) > config_.max_interval_s + 0.5) {
    has_last_ = false;
    walking_ = false;
    waiting_count_ = 0;
    typical_height_ *= 0.5;
  }
}

void StepDetector::consider_peak(const Peak& peak) {
  const double threshold =
      std::max(config_.threshold_mps2, config_.threshold_share * typical_height_);
  if (peak.height < threshold) return;
  if (has_last_ && to_seconds(peak.stamp_ns - last_peak_.stamp_ns) < config_.min_interval_s) return;
  accept(peak);
}

void StepDetector::accept(const Peak& peak) {
  typical_height_ += 0.25 * (peak.height - typical_height_);
  valley_ = peak.height;
  const double interval = has_last_ ? to_seconds(peak.stamp_ns - last_peak_.stamp_ns) : 0.0;
  if (has_last_ && interval > config_.max_interval_s) {
    walking_ = false;
    waiting_count_ = 0;
  }
  if (walking_) {
    emit(peak, interval);
  } else {
    if (waiting_count_ == waiting_.size()) {
      std::shift_left(waiting_.begin(), waiting_.end(), 1);
      --waiting_count_;
    }
    waiting_[waiting_count_++] = peak;
    if (regular()) confirm();
  }
  last_peak_ = peak;
  last_interval_s_ = interval;
  has_last_ = true;
}

bool StepDetector::regular() const {
  const auto needed = static_cast<std::size_t>(config_.confirming_steps);
  if (waiting_count_ < needed) return false;
  const std::size_t first = waiting_count_ - needed;
  double shortest = 1e9;
  double longest = 0.0;
  for (std::size_t i = first + 1; i < waiting_count_; ++i) {
    const double interval = to_seconds(waiting_[i].stamp_ns - waiting_[i - 1].stamp_ns);
    shortest = std::min(shortest, interval);
    longest = std::max(longest, interval);
  }
  return needed < 2 || longest - shortest <= config_.regularity * 0.5 * (longest + shortest);
}

void StepDetector::confirm() {
  walking_ = true;
  const auto needed = static_cast<std::size_t>(config_.confirming_steps);
  const std::size_t first = waiting_count_ - needed;
  last_interval_s_ = needed > 1
                         ? to_seconds(waiting_[first + 1].stamp_ns - waiting_[first].stamp_ns)
                         : config_.max_interval_s;
  for (std::size_t i = first; i < waiting_count_; ++i) {
    const double interval =
        i > first ? to_seconds(waiting_[i].stamp_ns - waiting_[i - 1].stamp_ns) : last_interval_s_;
    emit(waiting_[i], interval);
    last_interval_s_ = interval;
  }
  waiting_count_ = 0;
}

void StepDetector::emit(const Peak& peak, double interval_s) {
  if (queue_count_ == kQueue) return;  // as many as sixteen untaken steps: nobody listens
  DetectedStep step;
  step.stamp_ns = peak.stamp_ns;
  step.previous_ns = peak.stamp_ns - to_ns(interval_s);
  // Over a stride both legs count: left and right intervals differ.
  step.frequency_hz =
      last_interval_s_ > 0.0 ? 2.0 / (interval_s + last_interval_s_) : 1.0 / interval_s;
  step.swing_mps2 = peak.swing;
  queue_[(queue_begin_ + queue_count_) % kQueue] = step;
  ++queue_count_;
}

}  // namespace vpdr::pdr
