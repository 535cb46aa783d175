#include "imu_gateway/core/sensor_watch.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::imu_gateway {

/// Whether the axis is at the end of its range.
bool SensorWatch::watch(Axis& axis, TimestampNs stamp_ns, double value) const {
  if (value != axis.value || axis.repeats == 0) {
    axis.value = value;
    axis.since_ns = stamp_ns;
    axis.repeats = 0;
  }
  ++axis.repeats;
  axis.extreme = std::max(axis.extreme, std::abs(value));
  axis.stuck = axis.repeats >= options_.stuck_samples &&
               to_seconds(stamp_ns - axis.since_ns) >= options_.stuck_after_s;
  return axis.repeats >= options_.saturated_samples && std::abs(value) == axis.extreme &&
         axis.extreme >= options_.least_full_scale;
}

void SensorWatch::see(TimestampNs stamp_ns, const Eigen::Vector3d& value) {
  bool saturated = false;
  bool stuck = false;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const bool at_end = watch(axes_[i], stamp_ns, value[static_cast<Eigen::Index>(i)]);
    saturated = saturated || at_end;
    stuck = stuck || axes_[i].stuck;
  }
  if (saturated) ++saturated_;
  if (stuck) ++stuck_;
}

std::string_view SensorWatch::stuck_axes() const {
  static constexpr std::array<std::string_view, 8> kNames{"",  "x",  "y",  "xy",
                                                          "z", "xz", "yz", "xyz"};
  std::size_t index = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) index |= axes_[i].stuck ? std::size_t{1} << i : 0;
  return kNames[index];
}

}  // namespace vpdr::imu_gateway
