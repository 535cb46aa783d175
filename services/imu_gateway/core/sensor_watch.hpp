#pragma once
// A sensor that has stopped measuring though it still sends: an axis stuck at one value, or at the
// end of its range. Pure; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/time.hpp"

namespace vpdr::imu_gateway {

struct SensorWatchOptions {
  /// A value that comes again and again, to the last bit, for so long is no measurement: the noise
  /// of a sensor at rest turns its last bits.
  double stuck_after_s = 2.0;
  int stuck_samples = 40;
  /// Less is no full scale of any range in use.
  double least_full_scale = 0.0;
  /// The largest value ever seen on an axis, so often in a row, is the end of its range.
  int saturated_samples = 3;
};

class SensorWatch {
 public:
  explicit SensorWatch(const SensorWatchOptions& options) : options_(options) {}

  void see(TimestampNs stamp_ns, const Eigen::Vector3d& value);
  /// Axes stuck now, "x", "yz"; empty: none.
  [[nodiscard]] std::string_view stuck_axes() const;
  /// Samples with a stuck axis, and with one at the end of its range.
  [[nodiscard]] std::uint64_t stuck() const { return stuck_; }
  [[nodiscard]] std::uint64_t saturated() const { return saturated_; }

 private:
  struct Axis {
    double value = 0.0;
    double extreme = 0.0;  ///< largest magnitude seen
    TimestampNs since_ns = 0;
    int repeats = 0;
    bool stuck = false;
  };
  bool watch(Axis& axis, TimestampNs stamp_ns, double value) const;

  SensorWatchOptions options_;
  std::array<Axis, 3> axes_{};
  std::uint64_t stuck_ = 0;
  std::uint64_t saturated_ = 0;
};

}  // namespace vpdr::imu_gateway
