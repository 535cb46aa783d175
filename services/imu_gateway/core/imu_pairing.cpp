#include "imu_gateway/core/imu_pairing.hpp"

namespace vpdr::imu_gateway {

void ImuPairing::restart() {
  before_.reset();
  after_.reset();
  waiting_count_ = 0;
}

void ImuPairing::pair(const Rate& rate, std::vector<ImuSample>& out) {
  const bool exact = after_ && after_->stamp_ns == rate.stamp_ns;
  const bool between = before_ && after_ && before_->stamp_ns <= rate.stamp_ns &&
                       after_->stamp_ns - before_->stamp_ns <= kLongestGapNs;
  if (!exact && !between) {
    ++unpaired_;
    return;
  }
  ImuSample sample;
  sample.stamp_ns = rate.stamp_ns;
  sample.specific_force_mps2 = after_->mps2;
  if (!exact) {
    const double share = to_seconds(rate.stamp_ns - before_->stamp_ns) /
                         to_seconds(after_->stamp_ns - before_->stamp_ns);
    sample.specific_force_mps2 = before_->mps2 + share * (after_->mps2 - before_->mps2);
  }
  sample.angular_velocity_radps = rate.radps;
  out.push_back(sample);
}

void ImuPairing::add_force(TimestampNs stamp_ns, const Eigen::Vector3d& force_mps2,
                           std::vector<ImuSample>& out) {
  if (after_ && stamp_ns <= after_->stamp_ns) return;
  before_ = after_;
  after_ = Force{stamp_ns, force_mps2};
  std::size_t left = 0;
  for (std::size_t i = 0; i < waiting_count_; ++i) {
    if (waiting_[i].stamp_ns <= stamp_ns) {
      pair(waiting_[i], out);
    } else {
      waiting_[left++] = waiting_[i];
    }
  }
  waiting_count_ = left;
}

void ImuPairing::add_rate(TimestampNs stamp_ns, const Eigen::Vector3d& rate_radps,
                          std::vector<ImuSample>& out) {
  if (after_ && stamp_ns <= after_->stamp_ns) {
    pair({stamp_ns, rate_radps}, out);
  } else if (waiting_count_ < waiting_.size()) {
    waiting_[waiting_count_++] = Rate{stamp_ns, rate_radps};
  } else {
    ++unpaired_;
  }
}

}  // namespace vpdr::imu_gateway
