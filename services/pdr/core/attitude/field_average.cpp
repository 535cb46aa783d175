#include "pdr/core/attitude/field_average.hpp"

#include <algorithm>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// What lies further from the median of its block is no field of the place, uT.
constexpr double kOutlier_ut = 30.0;
}  // namespace

void FieldAverage::add(const MagSample& sample) {
  if (pending_count_ == pending_.size()) {
    std::shift_left(pending_.begin(), pending_.end(), 1);
    --pending_count_;
  }
  pending_[pending_count_++] = sample;
}

void FieldAverage::advance(TimestampNs stamp_ns, const Eigen::Quaterniond& odom_from_body,
                           const Eigen::Vector3d& rate_radps, double delay_s) {
  if (to_seconds(stamp_ns - last_ns_) > gap_s_) count_ = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pending_count_; ++i) {
    const MagSample mag = pending_[i];
    const double age_s = to_seconds(stamp_ns - mag.stamp_ns);
    if (age_s <= 0.0) {
      pending_[kept++] = mag;
    } else if (age_s <= kOldestField_s && count_ < kMost) {
      const Eigen::Matrix3d rotation =
          (odom_from_body * exp_rotation(-(age_s + delay_s) * rate_radps)).toRotationMatrix();
      if (count_ == 0) first_ns_ = mag.stamp_ns;
      entries_[count_++] = {rotation * mag.field_ut, rotation.topRows<2>()};
    }
  }
  pending_count_ = kept;
  last_ns_ = stamp_ns;
}

std::optional<MeanField> FieldAverage::take() {
  if (count_ == 0 || to_seconds(last_ns_ - first_ns_) < block_s_) return std::nullopt;
  const Eigen::Vector3d median = median_ut();
  MeanField mean;
  int agreeing = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if ((entries_[i].field_ut - median).squaredNorm() > kOutlier_ut * kOutlier_ut) continue;
    mean.horizontal_ut += entries_[i].field_ut.head<2>();
    mean.up_ut += entries_[i].field_ut.z();
    mean.level_rows += entries_[i].level_rows;
    ++agreeing;
  }
  outliers_ += count_ - static_cast<std::size_t>(agreeing);
  count_ = 0;
  if (agreeing == 0) return std::nullopt;
  mean.horizontal_ut /= agreeing;
  mean.up_ut /= agreeing;
  mean.level_rows /= agreeing;
  return mean;
}

/// Of each axis.
Eigen::Vector3d FieldAverage::median_ut() const {
  Eigen::Vector3d median;
  std::array<double, kMost> values{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < count_; ++i) values[i] = entries_[i].field_ut[axis];
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count_));
    median[axis] = *middle;
  }
  return median;
}

}  // namespace vpdr::pdr
