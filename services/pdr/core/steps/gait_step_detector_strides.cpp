// Strides of which one step alone shows: a limb that swings adds to one of them what it takes from
// the other.
#include <algorithm>
#include <cmath>

#include "pdr/core/steps/gait_step_detector.hpp"

namespace vpdr::pdr {

namespace {
/// A limb that swings with the strides turns the board by this, rad/s r.m.s.: 14 degrees to either
/// side in a second. Whoever does no more shows both steps of a stride, or takes none.
constexpr double kSwinging = 1.0;
}  // namespace

/// Peaks too far apart to be the steps of strides are strides themselves.
bool GaitStepDetector::begins_by_strides() const {
  if (on_trunk_ || waiting_count_ < kStrides || rate_radps_ < kSwinging) return false;
  double shortest_s = 1e9;
  double longest_s = 0.0;
  for (std::size_t i = waiting_count_ - kStrides + 1; i < waiting_count_; ++i) {
    const double stride_s = to_seconds(waiting_[i].stamp_ns - waiting_[i - 1].stamp_ns);
    shortest_s = std::min(shortest_s, stride_s);
    longest_s = std::max(longest_s, stride_s);
  }
  const double mean_s = 0.5 * (shortest_s + longest_s);
  return 2.0 * shortest_s > config_.longest_stride_s && longest_s <= config_.longest_stride_s &&
         longest_s - shortest_s <= config_.evenness * mean_s &&
         resemblance(mean_s) >= config_.resemblance &&
         tilt_rad(mean_s) <= config_.largest_tilt_rad && !handled(1.0);
}

/// Between this peak and the last step there was one that did not show.
bool GaitStepDetector::misses_one(const Peak& peak) const {
  if (on_trunk_ || given_count_ < 3 || waiting_count_ != 1) return false;
  const double stride_s = to_seconds(given_[0] - given_[2]);
  const double interval_s = to_seconds(peak.stamp_ns - given_[0]);
  return std::abs(interval_s - stride_s) <= 2 * config_.evenness * stride_s &&
         resemblance(interval_s) >= config_.resemblance &&
         tilt_rad(interval_s) <= config_.lasting_tilt_rad && !handled(kLastingPatience);
}

/// Puts a step that did not show before the one at that place.
void GaitStepDetector::fill_in(std::size_t place) {
  const Peak after = waiting_[place];
  const TimestampNs before_ns = place > 0 ? waiting_[place - 1].stamp_ns : given_[0];
  std::shift_right(waiting_.begin() + static_cast<std::ptrdiff_t>(place), waiting_.end(), 1);
  waiting_[place] = {before_ns + (after.stamp_ns - before_ns) / 2, after.height, after.swing,
                     false};
  ++waiting_count_;
}

}  // namespace vpdr::pdr
