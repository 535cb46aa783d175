#include "pdr/core/steps/spectrum_step_detector.hpp"

#include <cmath>
#include <complex>
#include <numeric>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
constexpr double kLowestHz = 1.0;
constexpr double kHighestHz = 3.2;
constexpr double kSpacingHz = 0.05;
constexpr double kLongestInPeriods = 1.6;
}  // namespace

void SpectrumStepDetector::add(const SignalValue& value, StepQueue& steps) {
  window_[seen_++ % kWindow] = value.norm_mps2;
  if (seen_ < kWindow || (seen_ - kWindow) % kHop != 0) return;
  const Wave wave = strongest();
  walking_ = wave.amplitude_mps2 > config_.spectrum_threshold_mps2;
  if (!walking_) return;
  const double half_window_s = 0.5 * (kWindow - 1) * StepSignal::kPeriodS;
  take_crests(wave, value.stamp_ns - to_ns(half_window_s), steps);
}

SpectrumStepDetector::Wave SpectrumStepDetector::strongest() const {
  const double mean = std::accumulate(window_.begin(), window_.end(), 0.0) / kWindow;
  Wave best;
  const auto count = static_cast<int>(std::lround((kHighestHz - kLowestHz) / kSpacingHz));
  for (int i = 0; i <= count; ++i) {
    const Wave wave = wave_at(kLowestHz + i * kSpacingHz, mean);
    if (wave.amplitude_mps2 > best.amplitude_mps2) best = wave;
  }
  return best;
}

SpectrumStepDetector::Wave SpectrumStepDetector::wave_at(double frequency_hz, double mean) const {
  // Hann's window, so that a strong neighbour does not leak in; its mean is one half.
  const double step = 2.0 * kPi * frequency_hz * StepSignal::kPeriodS;
  const double centre = 0.5 * (kWindow - 1);
  const std::complex<double> turn = std::polar(1.0, -step);
  std::complex<double> phasor = std::polar(1.0, step * centre);
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    const double weight =
        0.5 - 0.5 * std::cos(2.0 * kPi * (static_cast<double>(i) + 0.5) / kWindow);
    sum += weight * (window_[(seen_ + i) % kWindow] - mean) * phasor;
    weights += weight;
    phasor *= turn;
  }
  return {frequency_hz, 2.0 * std::abs(sum) / weights, std::arg(sum)};
}

void SpectrumStepDetector::take_crests(const Wave& wave, TimestampNs middle_ns, StepQueue& steps) {
  const double period_s = 1.0 / wave.frequency_hz;
  const double half_hop_s = 0.5 * kHop * StepSignal::kPeriodS;
  const double crest_s = -wave.phase_rad / (2.0 * kPi) * period_s;
  // Neighbouring windows differ a little in phase: a crest seen by both counts once.
  for (double n = std::ceil((-half_hop_s - crest_s) / period_s - 0.25);
       crest_s + n * period_s < half_hop_s; n += 1.0) {
    DetectedStep step;
    step.stamp_ns = middle_ns + to_ns(crest_s + n * period_s);
    step.previous_ns = step.stamp_ns - to_ns(period_s);
    if (last_step_) {
      const double since_s = to_seconds(step.stamp_ns - *last_step_);
      if (since_s < 0.6 * period_s) continue;
      // One that follows another by about a period goes on with its walk.
      if (since_s < kLongestInPeriods * period_s) step.previous_ns = *last_step_;
    }
    step.frequency_hz = wave.frequency_hz;
    step.swing_mps2 = 2.0 * wave.amplitude_mps2;
    steps.push(step);
    last_step_ = step.stamp_ns;
  }
}

}  // namespace vpdr::pdr
