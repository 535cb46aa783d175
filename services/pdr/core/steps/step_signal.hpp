#pragma once
// What every step detector looks at: the norm of specific force, which does not change with the
// way the board is held, at a fixed 50 Hz whatever the board's rate is; with it the direction the
// board hangs in and how fast it turns. A walk may be taken to go on through a silence of the board
// as it went a stride before. SI. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "core/time.hpp"

namespace vpdr::pdr {

struct SignalValue {
  TimestampNs stamp_ns = 0;
  TimestampNs heard_ns = 0;  ///< stamp of the measured value that this one is or repeats
  double norm_mps2 = 0.0;
  Eigen::Vector3d force_mps2 = Eigen::Vector3d::Zero();  ///< no longer than the norm may be
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< slow mean of specific force, unit, body axes
  double rate_radps = 0.0;                        ///< r.m.s. of the last second
};

class StepSignal {
 public:
  static constexpr double kRateHz = 50.0;
  static constexpr double kPeriodS = 0.02;

  /// @param gap_s no walk goes on through a longer silence.
  explicit StepSignal(double gap_s) : gap_s_(gap_s) {}

  /// A sample in any axes, the rate zero where unknown. False: the first one after half a second
  /// without any, or after a step back in time; what was known of the signal is void.
  bool add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
           const Eigen::Vector3d& angular_velocity_radps);
  /// The next value that the samples so far complete, oldest first.
  std::optional<SignalValue> take();
  /// Whether the sample at this stamp comes after a silence that hides part of a step, but in which
  /// a walk goes on.
  [[nodiscard]] bool is_silent_before(TimestampNs stamp_ns) const;
  /// The next value of a silence up to this stamp, none at its end: that of a stride before. None
  /// either where that only repeats what was heard long ago.
  std::optional<SignalValue> go_on(TimestampNs stamp_ns, double stride_s);

 private:
  static constexpr TimestampNs kPeriodNs = 20'000'000;
  static constexpr std::size_t kRemembered = 128;  ///< 2.5 s

  SignalValue remember(const SignalValue& value);

  double gap_s_;
  bool started_ = false;
  TimestampNs begin_ns_ = 0;  ///< the straight line between the last two samples
  TimestampNs end_ns_ = 0;
  double begin_norm_ = 0.0;
  double end_norm_ = 0.0;
  Eigen::Vector3d begin_force_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_force_ = Eigen::Vector3d::Zero();
  TimestampNs done_ns_ = 0;                               ///< up to here the line is used
  TimestampNs next_ns_ = 0;                               ///< end of the current grid cell
  double cell_sum_ = 0.0;                                 ///< integral of the norm over it
  Eigen::Vector3d cell_force_ = Eigen::Vector3d::Zero();  ///< of the force
  double cell_s_ = 0.0;
  Eigen::Vector3d slow_force_ = Eigen::Vector3d::Zero();
  double rate_variance_ = 0.0;
  std::array<SignalValue, kRemembered> remembered_{};
  std::size_t remembered_count_ = 0;
  std::size_t remembered_next_ = 0;
};

}  // namespace vpdr::pdr
