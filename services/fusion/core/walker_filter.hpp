#pragma once
// The walker's heading and position with their full covariance.
//
// Heading: the heading-rate filter S1.10, state [theta_dot theta] with transition (9) and
// measurement (10). Position: (11) and S1.3, x += l cos theta, y += l sin theta at each step.
//
// pdr's heading errs slowly and vision's rate errs in a way that cancels, so S1.10's independent
// noises would make the filter far too sure of itself and vision nearly worthless. Each
// correlated error is therefore a state of its own (shaping filter; those that nothing observes
// act as Schmidt's consider states, because their gain is zero while their correlation stays):
//
//   theta^m = theta - delay theta_dot + correlated + bias + white  (pdr's mean over the last step)
//   theta^s = theta + correlated + bias + white      (pdr's direction of a step, at its middle)
//   V       = theta - vision_zero + white            (vision; V = sum of rate x interval)
//   l       = length (1 + scale) + white             (step)
//
// The deviations pdr reports are totals; the parts that fusion knows to be constant are taken out
// of them, never added.
//
// The slow error is that of pdr's zero of yaw, and pdr learns: a revision is a measurement of the
// error as it was (of just the variance that takes pdr's from the old to the new one), so that it
// also corrects what was walked since. From then on the error is that of the revised zero.
//
// With HeadingNoise::kWhite and RateNoise::kWhite these vanish and S1.10 remains, to the letter.
//
// World ENU, radians, metres, seconds of the sensor clock. The filter holds no state: it advances
// a FilterState, a plain value that can be kept and returned to. Allocates nothing, throws nothing.
#include "fusion/core/filter_state.hpp"
#include "fusion/core/fusion_config.hpp"
#include "fusion/core/measurement.hpp"

namespace vpdr::fusion {

/// Advances FilterStates. Thread-safe: it only reads its configuration.
class WalkerFilter {
 public:
  explicit WalkerFilter(const FusionConfig& config) : config_(config) {}

  /// The state before anything was measured: at the origin, scale and bias as uncertain as set.
  [[nodiscard]] FilterState initial() const;
  /// Applies one measurement whose stamp is not before the state's.
  void apply(const Measurement& measurement, FilterState& state) const;
  /// Lets time pass, (9). Nothing happens before the first heading.
  void predict(TimestampNs stamp_ns, FilterState& state) const;
  /// Row r with r x = error of the yaw that an attitude of pdr has after the correction: what is
  /// not known of pdr's own error, whereas the walker's turning since then is in the attitude.
  [[nodiscard]] StateVector attitude_yaw_row() const;

 private:
  void use(const HeadingRate& rate, FilterState& state) const;
  void use(const HeadingEstimate& heading, FilterState& state) const;
  void use(const StepEvent& step, FilterState& state) const;

  void apply_white_rate(const HeadingRate& rate, FilterState& state) const;
  void apply_chained_rate(const HeadingRate& rate, FilterState& state) const;
  void begin_chain(const HeadingRate& rate, FilterState& state) const;
  [[nodiscard]] bool continues_chain(const HeadingRate& rate, const FilterState& state) const;
  void pass_correlated_error(TimestampNs stamp_ns, double sigma_rad, FilterState& state) const;
  /// Revisions add up and begin at zero: a zero after others is that of a pdr that started anew.
  static bool is_of_another_pdr(const HeadingEstimate& heading, const FilterState& state) {
    return heading.yaw_revision_rad == 0.0 && state.revision_rad != 0.0;
  }
  void revise(const HeadingEstimate& heading, FilterState& state) const;
  bool correct_yaw(double measured_rad, double delay_s, double variance, FilterState& state) const;
  void take_heading(const HeadingEstimate& heading, FilterState& state) const;
  void turn_world(const HeadingEstimate& heading, double angle_rad, FilterState& state) const;
  void close_walk(TimestampNs stamp_ns, FilterState& state) const;
  void forget_rate(double gap_s, FilterState& state) const;
  [[nodiscard]] double frame_variance(const HeadingRate& rate) const;
  [[nodiscard]] bool is_correlated() const {
    return config_.heading.noise == HeadingNoise::kCorrelated;
  }
  [[nodiscard]] double delay_s() const { return is_correlated() ? config_.heading.delay_s : 0.0; }
  [[nodiscard]] double bias_variance() const;
  [[nodiscard]] double white_sigma(double sigma_rad) const;
  [[nodiscard]] double white_sigma(const HeadingEstimate& heading) const;
  [[nodiscard]] double correlated_sigma(const HeadingEstimate& heading) const;

  FusionConfig config_;
};

}  // namespace vpdr::fusion
