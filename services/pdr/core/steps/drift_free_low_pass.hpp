#pragma once
// Zero-drift removal and Butterworth low-pass, as S3.1 prepares the norm of specific force for
// peak detection. Not thread-safe; allocates nothing.
#include "pdr/core/steps/butterworth.hpp"
#include "pdr/core/steps/step_config.hpp"

namespace vpdr::pdr {

class DriftFreeLowPass {
 public:
  explicit DriftFreeLowPass(const StepConfig& config);

  /// The next norm of specific force, 20 ms after the last; m/s^2 about zero.
  double filter(double norm_mps2);
  /// Delay at the frequency of an ordinary walk, s.
  [[nodiscard]] double delay_s() const { return delay_s_; }
  /// Swing before the filter, of a wave of that frequency which has this swing after it.
  [[nodiscard]] double unfiltered(double swing_mps2, double frequency_hz) const;

 private:
  double drift_time_s_;
  ButterworthLowPass low_pass_;
  double delay_s_;
  double mean_ = 0.0;
  double mean_age_s_ = 0.0;
};

/// Where between three equally spaced values the top of their parabola is: -0.5 to 0.5 of the
/// spacing from the middle one, which must be the largest.
double parabola_top(double before, double middle, double after);

}  // namespace vpdr::pdr
