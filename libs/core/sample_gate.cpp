#include "core/sample_gate.hpp"

#include <cmath>
#include <numeric>

namespace vpdr {

namespace {

/// From one sample to the next no walker's board changes by more, each axis; over a longer time
/// than this it may.
constexpr double kLargestForceJump_mps2 = 80.0;
constexpr double kLargestRateJump_radps = 10.0;
constexpr double kJumpTime_s = 0.1;

bool is_jump(const ImuSample& a, const ImuSample& b) {
  const auto largest = [](const auto& difference) { return difference.cwiseAbs().maxCoeff(); };
  return largest(b.specific_force_mps2 - a.specific_force_mps2) > kLargestForceJump_mps2 ||
         largest(b.angular_velocity_radps - a.angular_velocity_radps) > kLargestRateJump_radps;
}

/// Of any two stamps: their difference need not fit into 64 bits.
double seconds_between(TimestampNs from, TimestampNs to) {
  return 1e-9 * (static_cast<double>(to) - static_cast<double>(from));
}

}  // namespace

const char* name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNonFinite:
      return "non_finite";
    case Refusal::kDuplicate:
      return "duplicate";
    case Refusal::kBackwardInTime:
      return "backward_in_time";
    case Refusal::kOutOfRange:
      return "out_of_range";
    case Refusal::kTimeJump:
      return "time_jump";
  }
  return "unknown";
}

Refusal SampleGate::check(const ImuSample& s) {
  const bool finite = s.specific_force_mps2.allFinite() && s.angular_velocity_radps.allFinite();
  const bool in_range =
      s.specific_force_mps2.cwiseAbs().maxCoeff() <= limits_.specific_force_mps2 &&
      s.angular_velocity_radps.cwiseAbs().maxCoeff() <= limits_.angular_velocity_radps;
  const Refusal verdict = judge(s.stamp_ns, finite, in_range && !(finite && is_spike(s)));
  if (verdict == Refusal::kNone) {
    last_imu_ = s;
    doubted_imu_.reset();
  }
  return verdict;
}

bool SampleGate::is_spike(const ImuSample& sample) {
  if (!last_imu_ || sample.stamp_ns <= last_imu_->stamp_ns) return false;
  if (seconds_between(last_imu_->stamp_ns, sample.stamp_ns) >= kJumpTime_s) return false;
  if (!is_jump(*last_imu_, sample)) return false;
  if (doubted_imu_ && !is_jump(*doubted_imu_, sample)) return false;
  doubted_imu_ = sample;
  return true;
}

Refusal SampleGate::check(const MagSample& s) {
  return judge(s.stamp_ns, s.field_ut.allFinite(),
               s.field_ut.cwiseAbs().maxCoeff() <= limits_.field_ut);
}

Refusal SampleGate::check(const PressureSample& s) {
  return judge(
      s.stamp_ns, std::isfinite(s.pressure_pa),
      s.pressure_pa >= limits_.pressure_min_pa && s.pressure_pa <= limits_.pressure_max_pa);
}

std::uint64_t SampleGate::refused() const {
  return std::accumulate(counts_.begin() + 1, counts_.end(), std::uint64_t{0});
}

Refusal SampleGate::judge(TimestampNs stamp_ns, bool finite, bool in_range) {
  Refusal verdict = Refusal::kNone;
  if (!finite) {
    verdict = Refusal::kNonFinite;
  } else if (!in_range) {
    verdict = Refusal::kOutOfRange;
  } else {
    verdict = judge_time(stamp_ns);
  }
  ++counts_[static_cast<std::size_t>(verdict)];
  return verdict;
}

Refusal SampleGate::judge_time(TimestampNs stamp_ns) {
  const double ahead_s = last_ns_ ? seconds_between(*last_ns_, stamp_ns) : 0.0;
  const bool jumps_back = accepted() == 1 && ahead_s < -limits_.time_jump_s;
  if (ahead_s > limits_.time_jump_s || jumps_back) {
    const double after_jump_s = jumped_to_ns_ ? seconds_between(*jumped_to_ns_, stamp_ns) : 0.0;
    jumped_to_ns_ = stamp_ns;
    if (after_jump_s <= 0.0 || after_jump_s > limits_.time_jump_s) return Refusal::kTimeJump;
  } else if (last_ns_ && stamp_ns == *last_ns_) {
    return Refusal::kDuplicate;
  } else if (last_ns_ && stamp_ns < *last_ns_) {
    return Refusal::kBackwardInTime;
  }
  last_ns_ = stamp_ns;
  jumped_to_ns_.reset();
  return Refusal::kNone;
}

}  // namespace vpdr
