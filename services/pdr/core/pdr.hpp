#pragma once
// Pedestrian dead reckoning: attitude, steps, walking direction, position and height out of
// inertial, magnetometer and barometer samples. Body forward-left-up, world ENU, SI, radians; the
// start is the origin.
//
// Thread safety: none; one object for each walker. process() allocates nothing and throws nothing.
// Bad samples (non-finite, out of range, not later than the last) are refused with their reason and
// change nothing.
//
//   pdr::Pdr pdr(pdr::PdrConfig{});
//   pdr::PdrOutput output;
//   pdr.process(mag_sample);
//   if (pdr.process(imu_sample, output) == Refusal::kNone && output.step) use(*output.step);
#include <cstdint>
#include <optional>

#include "core/estimates.hpp"
#include "core/sample_gate.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "pdr/core/attitude/field_average.hpp"
#include "pdr/core/attitude/relative_attitude.hpp"
#include "pdr/core/carry.hpp"
#include "pdr/core/dead_reckoning/dead_reckoning.hpp"
#include "pdr/core/dead_reckoning/steady_start.hpp"
#include "pdr/core/heading/carried_axis.hpp"
#include "pdr/core/heading/forward_offset.hpp"
#include "pdr/core/heading/straight_stretches.hpp"
#include "pdr/core/heading/walking_heading.hpp"
#include "pdr/core/height/barometric_height.hpp"
#include "pdr/core/steps/step_detector.hpp"
#include "pdr/core/steps/step_length.hpp"
#include "pdr/core/steps/step_sequence.hpp"
#include "pdr/core/steps/tentative_steps.hpp"

namespace vpdr::pdr {

/// What may be known of who walks.
struct PersonConfig {
  double height_m = 0.0;  ///< m, standing; 0: unknown
};

/// Defaults are the product; running without a configuration file uses them.
struct PdrConfig {
  PersonConfig person;
  Carry carry = Carry::kUnknown;  ///< where the board is worn; goes to every part that can use it
  AttitudeConfig attitude;
  StepConfig step;
  StepLengthConfig step_length;
  HeadingConfig heading;
  ForwardOffsetConfig forward;
  StraightConfig straight;
  DeadReckoningConfig dead_reckoning;
  FieldConfig field;
  HeightConfig height;
  SampleLimits limits;
};

/// What one inertial sample brings.
struct PdrOutput {
  std::optional<AttitudeEstimate> attitude;  ///< with every accepted sample
  /// Tentative, confirmed or withdrawn; its stamp is the peak's, a little in the past.
  std::optional<StepEvent> step;
  std::optional<HeadingEstimate> heading;  ///< every heading period and with each step
  /// With every accepted sample. Its yaw is dead reckoning's, which trusts the gyroscope over a
  /// whole walk, not the attitude's, which follows the magnetometer within seconds.
  std::optional<PoseEstimate> odometry;
};

class Pdr {
 public:
  explicit Pdr(const PdrConfig& config = {});

  /// Overwrites `output` with what the sample brings; empty when the sample is refused.
  Refusal process(const ImuSample& sample, PdrOutput& output);
  /// Kept until the first inertial sample that is later.
  Refusal process(const MagSample& sample);
  /// Without any of these the height stays 0, as uncertain as the way is long.
  Refusal process(const PressureSample& sample);

  /// The latest confirmed step is known to have been so long, by vision or between known places:
  /// the walker's scale is learned (S1.13).
  void learn_from_distance(double distance_m);

  /// The undisturbed field by the board's calibration: strength, and angle below the horizon. A
  /// strength of 0 is no calibration. So a walk that begins beside steel is recognised.
  void expect_field(double strength_ut, double dip_rad);

  [[nodiscard]] const StepLengthModel& step_length() const { return step_length_; }
  [[nodiscard]] const FieldAverage& field() const { return field_; }
  [[nodiscard]] const SampleGate& imu_gate() const { return imu_gate_; }
  [[nodiscard]] const SampleGate& mag_gate() const { return mag_gate_; }
  [[nodiscard]] const SampleGate& pressure_gate() const { return pressure_gate_; }
  [[nodiscard]] const AttitudeFilter& attitude() const { return attitude_; }
  [[nodiscard]] const DeadReckoning& dead_reckoning() const { return dead_reckoning_; }
  [[nodiscard]] const BarometricHeight& height() const { return height_; }
  [[nodiscard]] std::uint32_t step_count() const { return step_count_; }
  [[nodiscard]] bool walking() const { return steps_.walking(); }

 private:
  void expect_velocity(TimestampNs stamp_ns);
  void follow_heading(const ImuSample& sample);
  void follow_carry();
  void follow_halt(TimestampNs stamp_ns);
  void follow_forward(const DetectedStep& detected);
  void follow_corridors(double walking_yaw_rad);
  StepEvent take_step(const DetectedStep& detected);
  [[nodiscard]] StepEvent event_of(const DetectedStep& detected,
                                   const DeadReckonedStep& step) const;
  [[nodiscard]] HeadingEstimate heading_at(TimestampNs stamp_ns) const;
  [[nodiscard]] bool heading_is_due(TimestampNs stamp_ns);
  [[nodiscard]] PoseEstimate odometry(TimestampNs stamp_ns) const;
  [[nodiscard]] double on_stairs() const;
  [[nodiscard]] Matrix6d odometry_covariance(TimestampNs stamp_ns) const;
  [[nodiscard]] double height_variance_m2(TimestampNs stamp_ns) const;
  [[nodiscard]] Eigen::Matrix2d body_about_steps() const;
  [[nodiscard]] Eigen::Vector2d along_last_step() const;

  PdrConfig config_;
  SampleGate imu_gate_;
  SampleGate mag_gate_;
  SampleGate pressure_gate_;
  AttitudeFilter attitude_;
  RelativeAttitude relative_;
  FieldAverage field_;
  SteadyStart steady_start_;
  StepDetector steps_;
  StepLengthModel step_length_;
  CarriedAxis axis_;
  WalkingHeading heading_;
  ForwardOffset forward_;
  StraightStretches straight_;
  bool straight_is_absolute_ = false;  ///< the yaws that it knows
  DeadReckoning dead_reckoning_;
  BarometricHeight height_;
  TentativeSteps tentative_;

  std::uint32_t step_count_ = 0;
  StepSequence sequence_;  ///< yaws relative
  std::optional<TimestampNs> next_heading_;
};

}  // namespace vpdr::pdr
