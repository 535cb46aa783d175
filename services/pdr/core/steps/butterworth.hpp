#pragma once
// Butterworth low-pass of second or fourth order, from first principles: the analogue prototype's
// pole pairs, pre-warped and carried over by the bilinear transform, one biquad each (S3.1).
// Not thread-safe; allocates nothing.
#include <array>
#include <cstddef>

namespace vpdr::pdr {

/// One second-order section b0 + b1 z^-1 + b2 z^-2 over 1 + a1 z^-1 + a2 z^-2.
struct Biquad {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
  double s1 = 0.0, s2 = 0.0;  ///< memory, transposed direct form II

  double filter(double input);
  /// Memory of a filter that has seen `input` for ever.
  void settle(double input);
};

/// Low-pass with unit gain at zero frequency and 1/sqrt(2) at the cut-off. The first sample settles
/// it, so that a constant passes without a transient.
class ButterworthLowPass {
 public:
  /// @param order 2 or 4; anything else is taken as 2.
  /// @param cutoff_hz above 0; held below 0.45 of the rate.
  /// @param rate_hz sampling rate, above 0.
  ButterworthLowPass(int order, double cutoff_hz, double rate_hz);

  double filter(double input);

  /// New rate with the memory settled on the last output: for a stream whose rate changes.
  void set_rate(double rate_hz);

  /// Gain at a frequency below half the rate.
  [[nodiscard]] double gain(double frequency_hz) const;
  /// Delay in seconds of a sinusoid of that frequency (phase delay), frequency above 0.
  [[nodiscard]] double delay_s(double frequency_hz) const;
  [[nodiscard]] double rate_hz() const { return rate_hz_; }

 private:
  void design();

  std::array<Biquad, 2> sections_{};
  std::size_t section_count_;
  double cutoff_hz_;
  double rate_hz_;
  double last_output_ = 0.0;
  bool settled_ = false;
};

}  // namespace vpdr::pdr
