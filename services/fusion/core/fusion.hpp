#pragma once
// One pose out of what pdr and vision say, in whatever order it arrives.
//
// Position: by steps; from one to the next it is carried on by pdr's speed, half a step at most
// (the covariance tells the step under way). What pdr learned of its walk so far bends it as it
// bends pdr's own (pdr_walk.hpp): without vision the position is pdr's. Orientation: pdr's attitude
// turned about the vertical by fused yaw minus pdr yaw. Frames: the world of pdr (ENU, yaw 0 = east
// once pdr's yaw is absolute); the origin is where the first step began. Covariance of the pose: x
// y z, rotation about world x y z.
//
// Order: rates, headings and steps are kept for `history.horizon_s` behind pdr's newest stamp and
// applied in the order of their stamps; the result is the same, bit by bit, for every order of
// arrival within that horizon. Later ones are refused and counted. Attitudes are not kept: the
// newest by stamp serves.
//
// Modes rest on sensor stamps only: no clock is read. Not thread-safe. process() and latest()
// allocate, log and throw nothing.
#include <array>
#include <cstdint>
#include <optional>

#include "core/estimates.hpp"
#include "core/sample_gate.hpp"
#include "fusion/core/fusion_config.hpp"
#include "fusion/core/history.hpp"
#include "fusion/core/pdr_walk.hpp"

namespace vpdr::fusion {

/// What fusion is fed, for its counters.
enum class Input : std::uint8_t { kOdometry, kHeading, kStep, kRate, kCorridor };
inline constexpr std::size_t kInputCount = 5;

/// Counters of one input at the boundary: accepted, and refused by reason. kBackwardInTime: later
/// than the horizon. kOutOfRange: a value no walker has, or vision's stamp far ahead of pdr's (the
/// clocks of the two hosts differ).
struct InputCounters {
  std::array<std::uint64_t, kRefusalCount> by_refusal{};

  [[nodiscard]] std::uint64_t accepted() const { return by_refusal[0]; }
  [[nodiscard]] std::uint64_t refused(Refusal reason) const {
    return by_refusal[static_cast<std::size_t>(reason)];
  }
};

/// For `diagnostics`.
struct FusionDiagnostics {
  std::array<InputCounters, kInputCount> inputs{};
  InnovationCounters headings;
  InnovationCounters rates;
  std::uint64_t corridors_found = 0;
  std::uint64_t reapplied = 0;  ///< measurements applied again because of late ones
  std::uint32_t steps = 0;
  FusionMode mode = FusionMode::kWaiting;
};

class Fusion {
 public:
  explicit Fusion(const FusionConfig& config = {});

  Refusal process(const PoseEstimate& pdr_odometry);
  Refusal process(const HeadingEstimate& heading);
  Refusal process(const StepEvent& step);
  Refusal process(const HeadingRate& rate);
  /// Counted and shown in diagnostics; this filter's heading rests on the rate only.
  Refusal process(const CorridorHeading& corridor);

  /// The pose at the stamp of pdr's newest attitude (coasting: at the newest stamp of all);
  /// nothing before the first heading and attitude of pdr.
  [[nodiscard]] std::optional<FusedPose> latest() const;
  [[nodiscard]] FusionMode mode() const;
  [[nodiscard]] FusionDiagnostics diagnostics() const;
  /// The filter after the newest measurement, for tests and tuning.
  [[nodiscard]] const FilterState& state() const { return history_.state(); }

 private:
  Refusal count(Input input, Refusal refusal);
  Refusal insert(const Measurement& measurement);
  [[nodiscard]] bool is_ahead_of_pdr(TimestampNs stamp_ns) const;
  void note_pdr(TimestampNs stamp_ns);
  void note_vision(TimestampNs stamp_ns);
  [[nodiscard]] TimestampNs newest_ns() const;
  [[nodiscard]] Eigen::Vector2d ahead_of_last_step(TimestampNs stamp_ns,
                                                   const FilterState& state) const;
  [[nodiscard]] Eigen::Vector2d news_of_pdr(const FilterState& state) const;
  [[nodiscard]] Eigen::Matrix2d body_about_steps(const FilterState& state) const;
  [[nodiscard]] Matrix6d covariance_of(const FilterState& state) const;

  FusionConfig config_;
  History history_;
  History inertial_;  ///< the same without vision, if pdr's walk is to be followed
  PdrWalk pdr_walk_;
  std::optional<PoseEstimate> odometry_;
  std::optional<TimestampNs> pdr_ns_;     ///< newest stamp of pdr
  std::optional<TimestampNs> vision_ns_;  ///< newest stamp of vision
  std::uint64_t corridors_found_ = 0;
  std::array<InputCounters, kInputCount> inputs_{};
};

}  // namespace vpdr::fusion
