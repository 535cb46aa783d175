#pragma once
// When a walker's weight goes from one leg to the other, seen by a board on the trunk. While one
// foot carries the body, the body falls away from it and leans over it: the lateral specific force
// keeps one sign until the other foot takes over. That shows in slow, short and turning steps too,
// which hardly bounce, and not while one stands, for the centre of mass is then above the feet.
//
// Which of the board's axes is lateral is learnt from a walk's bounces: across the walker
// everything changes sign from step to step, along his way it repeats. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "pdr/core/steps/drift_free_low_pass.hpp"
#include "pdr/core/steps/step_signal.hpp"

namespace vpdr::pdr {

class WeightTransfer {
 public:
  explicit WeightTransfer(const StepConfig& config);

  /// The signal was interrupted; the axis stays known.
  void restart();
  /// The next value of the signal. When the weight went over, as soon as that is sure.
  std::optional<TimestampNs> add(const SignalValue& value);
  /// When one leg was last seen to carry alone.
  [[nodiscard]] TimestampNs one_leg_until_ns() const { return one_leg_until_ns_; }
  /// A bounce came so long after the one before it.
  void learn(double step_s);
  /// Lateral axis, unit, body axes, either sign; none as long as it is not clear.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& axis() const { return axis_; }

 private:
  static constexpr std::size_t kHistory = 128;  ///< 2.5 s

  [[nodiscard]] const Eigen::Vector3d& history(std::size_t age) const {
    return history_[(next_ + kHistory - 1 - age) % kHistory];
  }
  void find_axis();

  StepConfig filter_config_;
  double least_mps2_;
  std::array<DriftFreeLowPass, 3> filters_;
  std::array<Eigen::Vector3d, kHistory> history_{};  ///< filtered force
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  double lateral_mps2_ = 0.0;
  TimestampNs stamp_ns_ = 0;
  TimestampNs crossing_ns_ = 0;  ///< when the lateral force last changed sign
  TimestampNs one_leg_until_ns_ = 0;
  int side_ = 0;  ///< sign of the lateral force since it was last clear

  Eigen::Matrix3d repeated_ = Eigen::Matrix3d::Zero();  ///< sum of products, a step apart
  Eigen::Matrix3d energy_ = Eigen::Matrix3d::Zero();    ///< the same at one instant
  int steps_ = 0;                                       ///< learned from, up to those needed
  std::optional<Eigen::Vector3d> axis_;
};

}  // namespace vpdr::pdr
