#include "pdr/core/heading/walking_heading.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

double sway_sigma_rad(const HeadingConfig& config, Carry carry) {
  return on_trunk(carry) ? config.sway_sigma_rad : config.loose_sigma_rad;
}

Eigen::Vector2d forward_heading(const Eigen::Quaterniond& q) {
  return {1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()), 2.0 * (q.w() * q.z() + q.x() * q.y())};
}

void WalkingHeading::add(TimestampNs stamp_ns, const Eigen::Vector2d& heading) {
  if (started_ && stamp_ns < newest_.stamp_ns) reset();
  if (!started_) {
    newest_ = Entry{stamp_ns, Eigen::Vector2d::Zero()};
    started_ = true;
  }
  newest_.sum += to_seconds(stamp_ns - newest_.stamp_ns) * heading;
  newest_.stamp_ns = stamp_ns;
  if (count_ > 0 && stamp_ns - at(0).stamp_ns < kSpacing) return;
  entries_[next_] = newest_;
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

void WalkingHeading::reset() {
  count_ = 0;
  next_ = 0;
  started_ = false;
}

double WalkingHeading::Mean::unclear_sigma_rad() const { return (1.0 - clarity) * kPi; }

WalkingHeading::Mean WalkingHeading::mean(TimestampNs from_ns, TimestampNs to_ns) const {
  if (count_ == 0) return {};
  const TimestampNs from = std::max(from_ns, at(count_ - 1).stamp_ns);
  const TimestampNs to = std::min(to_ns, newest_.stamp_ns);
  if (to <= from) return {};
  const Eigen::Vector2d mean = (sum_at(to) - sum_at(from)) / to_seconds(to - from);
  return {std::atan2(mean.y(), mean.x()), std::min(1.0, mean.norm())};
}

Eigen::Vector2d WalkingHeading::sum_at(TimestampNs stamp_ns) const {
  const Entry* later = &newest_;
  for (std::size_t age = 0; age < count_; ++age) {
    const Entry& earlier = at(age);
    if (earlier.stamp_ns <= stamp_ns) {
      const TimestampNs span = later->stamp_ns - earlier.stamp_ns;
      if (span <= 0) return earlier.sum;
      const double share = to_seconds(stamp_ns - earlier.stamp_ns) / to_seconds(span);
      return earlier.sum + share * (later->sum - earlier.sum);
    }
    later = &earlier;
  }
  return later->sum;
}

}  // namespace vpdr::pdr
