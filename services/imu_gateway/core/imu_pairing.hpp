#pragma once
// One inertial stream out of an accelerometer and a gyroscope that are read at rates and instants
// of their own. Each rate gets the specific force at its instant, interpolated between the two
// measurements around it. Pure; bounded memory.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/samples.hpp"

namespace vpdr::imu_gateway {

/// Waits with each rate for the force after it: at most one period of the accelerometer. Rates
/// with no force before them, or with one too long ago, are left out and counted, not made up.
class ImuPairing {
 public:
  void add_force(TimestampNs stamp_ns, const Eigen::Vector3d& force_mps2,
                 std::vector<ImuSample>& out);
  void add_rate(TimestampNs stamp_ns, const Eigen::Vector3d& rate_radps,
                std::vector<ImuSample>& out);
  void restart();
  [[nodiscard]] std::uint64_t unpaired() const { return unpaired_; }

 private:
  struct Force {
    TimestampNs stamp_ns = 0;
    Eigen::Vector3d mps2 = Eigen::Vector3d::Zero();
  };
  struct Rate {
    TimestampNs stamp_ns = 0;
    Eigen::Vector3d radps = Eigen::Vector3d::Zero();
  };
  void pair(const Rate& rate, std::vector<ImuSample>& out);

  /// Further apart, two forces say nothing of what was between them.
  static constexpr TimestampNs kLongestGapNs = kNsPerSecond / 10;
  static constexpr std::size_t kMostWaiting = 256;
  std::optional<Force> before_;
  std::optional<Force> after_;
  std::array<Rate, kMostWaiting> waiting_;
  std::size_t waiting_count_ = 0;
  std::uint64_t unpaired_ = 0;
};

}  // namespace vpdr::imu_gateway
