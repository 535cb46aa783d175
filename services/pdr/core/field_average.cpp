#include "pdr/core/field_average.hpp"

#include <algorithm>

#include "core/rotation.hpp"

namespace vpdr::pdr {

void FieldAverage::add(const MagSample& sample) {
  if (pending_count_ == pending_.size()) {
    std::shift_left(pending_.begin(), pending_.end(), 1);
    --pending_count_;
  }
  pending_[pending_count_++] = sample;
}

void FieldAverage::advance(TimestampNs stamp_ns, const Eigen::Quaterniond& odom_from_body,
                           const Eigen::Vector3d& rate_radps) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pending_count_; ++i) {
    const MagSample mag = pending_[i];
    const double age_s = to_seconds(stamp_ns - mag.stamp_ns);
    if (age_s <= 0.0) {
      pending_[kept++] = mag;
    } else if (age_s <= kOldestField_s) {
      const Eigen::Matrix3d rotation =
          (odom_from_body * exp_rotation(-age_s * rate_radps)).toRotationMatrix();
      if (count_ == 0) first_ns_ = mag.stamp_ns;
      sum_.horizontal_ut += rotation.topRows<2>() * mag.field_ut;
      sum_.up_ut += rotation.row(2) * mag.field_ut;
      sum_.level_rows += rotation.topRows<2>();
      ++count_;
    }
  }
  pending_count_ = kept;
  last_ns_ = stamp_ns;
}

std::optional<MeanField> FieldAverage::take() {
  if (count_ == 0 || to_seconds(last_ns_ - first_ns_) < block_s_) return std::nullopt;
  const MeanField mean{sum_.horizontal_ut / count_, sum_.up_ut / count_, sum_.level_rows / count_};
  sum_ = MeanField{};
  count_ = 0;
  return mean;
}

}  // namespace vpdr::pdr
