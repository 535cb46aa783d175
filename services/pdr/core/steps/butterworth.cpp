#include "pdr/core/steps/butterworth.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {

/// Bilinear transform of the analogue pair 1 / (s^2 + s / q + 1), s in units of the warped cut-off.
Biquad low_pass_section(double warped, double q) {
  const double square = warped * warped;
  const double scale = 1.0 / (1.0 + warped / q + square);
  Biquad section;
  section.b0 = square * scale;
  section.b1 = 2.0 * section.b0;
  section.b2 = section.b0;
  section.a1 = 2.0 * (square - 1.0) * scale;
  section.a2 = (1.0 - warped / q + square) * scale;
  return section;
}

std::complex<double> response(const Biquad& s, double omega) {
  const std::complex<double> z1 = std::polar(1.0, -omega);
  const std::complex<double> z2 = z1 * z1;
  return (s.b0 + s.b1 * z1 + s.b2 * z2) / (1.0 + s.a1 * z1 + s.a2 * z2);
}

}  // namespace

double Biquad::filter(double input) {
  const double output = b0 * input + s1;
  s1 = b1 * input - a1 * output + s2;
  s2 = b2 * input - a2 * output;
  return output;
}

void Biquad::settle(double input) {
  // Unit gain at zero frequency: the output equals the input.
  s2 = (b2 - a2) * input;
  s1 = (b1 - a1) * input + s2;
}

ButterworthLowPass::ButterworthLowPass(int order, double cutoff_hz, double rate_hz)
    : section_count_(order == 4 ? 2 : 1), cutoff_hz_(cutoff_hz), rate_hz_(rate_hz) {
  design();
}

double ButterworthLowPass::filter(double input) {
  if (!settled_) {
    for (Biquad& section : sections_) section.settle(input);
    settled_ = true;
  }
  double value = input;
  for (std::size_t i = 0; i < section_count_; ++i) value = sections_[i].filter(value);
  last_output_ = value;
  return value;
}

void ButterworthLowPass::set_rate(double rate_hz) {
  rate_hz_ = rate_hz;
  design();
  for (Biquad& section : sections_) section.settle(last_output_);
}

double ButterworthLowPass::gain(double frequency_hz) const {
  double gain = 1.0;
  for (std::size_t i = 0; i < section_count_; ++i) {
    gain *= std::abs(response(sections_[i], 2.0 * kPi * frequency_hz / rate_hz_));
  }
  return gain;
}

double ButterworthLowPass::delay_s(double frequency_hz) const {
  double phase = 0.0;
  for (std::size_t i = 0; i < section_count_; ++i) {
    // Each section lags between 0 and pi, so that its phase never wraps.
    const double lag = -std::arg(response(sections_[i], 2.0 * kPi * frequency_hz / rate_hz_));
    phase += lag < -1e-9 ? lag + 2.0 * kPi : lag;
  }
  return phase / (2.0 * kPi * frequency_hz);
}

void ButterworthLowPass::design() {
  // Poles of the prototype at angles (2k + 1) pi / (2 n) from the imaginary axis.
  const double cutoff = std::min(cutoff_hz_, 0.45 * rate_hz_);
  const double warped = std::tan(kPi * cutoff / rate_hz_);
  const auto poles = static_cast<double>(2 * section_count_);
  for (std::size_t i = 0; i < section_count_; ++i) {
    const double angle = kPi * (2.0 * static_cast<double>(i) + 1.0) / (2.0 * poles);
    sections_[i] = low_pass_section(warped, 1.0 / (2.0 * std::sin(angle)));
  }
}

}  // namespace vpdr::pdr
