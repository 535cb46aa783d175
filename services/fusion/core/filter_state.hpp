#pragma once
// What the walker's filter knows at one instant, as a plain value, and what a Kalman filter does to
// any such value: one scalar correction, one state made independent or a copy of another. What the
// states mean is told in walker_filter.hpp. Radians, metres, seconds. Allocates nothing.
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::fusion {

/// Where each quantity stands in the state.
enum StateIndex : std::uint8_t {
  kRate,        ///< theta_dot, rad/s
  kYaw,         ///< theta, walking direction, rad
  kCorrelated,  ///< slow error of pdr's heading, rad
  kBias,        ///< constant error of pdr's heading, rad
  kScale,       ///< relative error of every step length
  kVisionZero,  ///< yaw at which vision's summed turn V is zero, rad
  kX,           ///< m
  kY,           ///< m
  kStateSize
};

using StateVector = Eigen::Matrix<double, kStateSize, 1>;
using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;

/// What became of one kind of measurement.
struct InnovationCounters {
  std::uint64_t accepted = 0;
  std::uint64_t gated = 0;   ///< refused as improbable
  std::uint64_t resets = 0;  ///< heading: taken as it is; rate: a new chain begun
  double nis_sum = 0.0;      ///< of the accepted ones: normalised innovations squared
};

/// Everything the filter knows at one instant of sensor time.
struct FilterState {
  TimestampNs stamp_ns = 0;
  bool has_heading = false;
  bool yaw_is_absolute = false;
  StateVector x = StateVector::Zero();
  StateMatrix p = StateMatrix::Zero();

  TimestampNs heading_ns = 0;         ///< of the last heading
  double correlated_sigma_rad = 0.0;  ///< unconditional, of kCorrelated at heading_ns
  double correction_rad = 0.0;        ///< theta minus pdr's heading, at heading_ns
  double revision_rad = 0.0;          ///< of pdr's zero of yaw, that kCorrelated refers to
  /// Where the pdr that speaks now began: its zero of yaw turns what was walked since.
  Eigen::Vector2d turns_about_m = Eigen::Vector2d::Zero();
  std::optional<TimestampNs> refusing_since_ns;

  bool has_chain = false;              ///< kVisionZero is in use
  TimestampNs chain_ns = 0;            ///< end of the chain's last interval
  double chain_turn_rad = 0.0;         ///< V
  std::optional<TimestampNs> rate_ns;  ///< of the last rate that was accepted

  std::uint32_t steps = 0;
  double distance_m = 0.0;
  double last_step_m = 0.0;
  double last_step_period_s = 0.0;
  Eigen::Vector2d last_step_along = Eigen::Vector2d::UnitX();
  TimestampNs last_step_ns = 0;
  InnovationCounters headings;
  InnovationCounters rates;
};

/// One scalar measurement: innovation, its row of the measurement matrix, its variance.
struct Innovation {
  double value;
  StateVector row;
  double variance;
};

/// Kalman update unless the innovation is improbable; counts either way and says which.
bool correct(const Innovation& innovation, double gate_sigmas, InnovationCounters& counters,
             FilterState& state);
/// x_to = sign x_from + independent noise: covariance of a state replaced by a copy of another.
void replace_by_copy(StateIndex to, StateIndex from, double sign, double added_variance,
                     FilterState& state);
/// Makes one state independent of the others.
void make_independent(StateIndex index, double variance, FilterState& state);

}  // namespace vpdr::fusion
