#include "pdr/core/steps/step_signal.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {
/// Time over which the r.m.s. rate is taken, s.
constexpr double kRateMemoryS = 1.0;
/// Runners' steps are no stronger, m/s^2; what is, is a knock.
constexpr double kStrongest_mps2 = 40.0;
/// Time over which the board's hanging direction follows: about a step, s.
constexpr double kUpMemoryS = 0.5;
/// A straight line through a longer silence misses what a step does, s.
constexpr double kSilenceS = 0.15;
/// And one through a longer silence nothing but invents, s.
constexpr double kLongestLineS = 0.5;
/// Of silences that follow one another closely, how many of the longest a stride is repeated for.
constexpr double kRepeatedGaps = 2.0;
}  // namespace

bool StepSignal::add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
                     const Eigen::Vector3d& angular_velocity_radps) {
  const double whole = specific_force_mps2.norm();
  const double norm = std::min(whole, kStrongest_mps2);
  const Eigen::Vector3d force =
      whole > norm ? Eigen::Vector3d(norm / whole * specific_force_mps2) : specific_force_mps2;
  const double span_s = to_seconds(stamp_ns - end_ns_);
  if (!started_ || span_s <= 0.0 || span_s > kLongestLineS) {
    *this = StepSignal(gap_s_);
    started_ = true;
    begin_ns_ = end_ns_ = done_ns_ = stamp_ns;
    begin_norm_ = end_norm_ = norm;
    begin_force_ = end_force_ = force;
    next_ns_ = stamp_ns + kPeriodNs;
    slow_force_ = specific_force_mps2;
    return false;
  }
  begin_ns_ = end_ns_;
  begin_norm_ = end_norm_;
  begin_force_ = end_force_;
  end_ns_ = stamp_ns;
  end_norm_ = norm;
  end_force_ = force;
  rate_variance_ += std::min(1.0, span_s / kRateMemoryS) *
                    (angular_velocity_radps.squaredNorm() - rate_variance_);
  slow_force_ += std::min(1.0, span_s / kUpMemoryS) * (specific_force_mps2 - slow_force_);
  return true;
}

std::optional<SignalValue> StepSignal::take() {
  // Mean of the straight line over each grid cell: interpolates slow streams, averages fast ones.
  if (done_ns_ >= end_ns_) return std::nullopt;
  const TimestampNs to_ns = std::min(end_ns_, next_ns_);
  const double dt = to_seconds(to_ns - done_ns_);
  const double middle_s = to_seconds(done_ns_ - begin_ns_) + 0.5 * dt;
  const double share = middle_s / to_seconds(end_ns_ - begin_ns_);
  cell_sum_ += (begin_norm_ + share * (end_norm_ - begin_norm_)) * dt;
  cell_force_ += (begin_force_ + share * (end_force_ - begin_force_)) * dt;
  cell_s_ += dt;
  done_ns_ = to_ns;
  if (to_ns != next_ns_) return std::nullopt;
  SignalValue value;
  value.stamp_ns = value.heard_ns = next_ns_ - kPeriodNs / 2;
  value.norm_mps2 = cell_sum_ / cell_s_;
  value.force_mps2 = cell_force_ / cell_s_;
  value.up = slow_force_.normalized();
  value.rate_radps = std::sqrt(rate_variance_);
  return remember(value);
}

bool StepSignal::is_silent_before(TimestampNs stamp_ns) const {
  const double span_s = to_seconds(stamp_ns - end_ns_);
  return started_ && span_s > kSilenceS && span_s <= gap_s_;
}

std::optional<SignalValue> StepSignal::go_on(TimestampNs stamp_ns, double stride_s) {
  const auto lag = static_cast<std::size_t>(std::lround(stride_s * kRateHz));
  if (next_ns_ >= stamp_ns || lag == 0 || lag > remembered_count_) return std::nullopt;
  SignalValue value = remembered_[(remembered_next_ + kRemembered - lag) % kRemembered];
  value.stamp_ns = next_ns_ - kPeriodNs / 2;
  // Whoever stops would be taken on without end.
  if (to_seconds(value.stamp_ns - value.heard_ns) > kRepeatedGaps * gap_s_ + stride_s) {
    return std::nullopt;
  }
  begin_ns_ = end_ns_ = done_ns_ = next_ns_;
  begin_norm_ = end_norm_ = value.norm_mps2;
  begin_force_ = end_force_ = value.force_mps2;
  return remember(value);
}

/// The cell that ends with it is over.
SignalValue StepSignal::remember(const SignalValue& value) {
  remembered_[remembered_next_] = value;
  remembered_next_ = (remembered_next_ + 1) % kRemembered;
  remembered_count_ = std::min(remembered_count_ + 1, kRemembered);
  cell_sum_ = 0.0;
  cell_force_.setZero();
  cell_s_ = 0.0;
  next_ns_ += kPeriodNs;
  return value;
}

}  // namespace vpdr::pdr
