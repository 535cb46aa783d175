#pragma once
// S1.1: steps from the Fourier transform. Each half second the spectrum of the last 2.56 s of the
// norm is taken between 1 and 3.2 Hz; where its strongest amplitude passes a threshold somebody
// walks with that frequency, and each crest of that wave in the middle half second is a step.
// So it speaks late, 1.3 s, and knows no single step.
#include <array>
#include <optional>

#include "pdr/core/steps/detected_step.hpp"
#include "pdr/core/steps/step_config.hpp"
#include "pdr/core/steps/step_signal.hpp"

namespace vpdr::pdr {

class SpectrumStepDetector {
 public:
  explicit SpectrumStepDetector(const StepConfig& config) : config_(config) {}

  void restart(StepQueue& /*steps*/) { *this = SpectrumStepDetector(config_); }
  void add(const SignalValue& value, StepQueue& steps);
  [[nodiscard]] bool walking() const { return walking_; }

  /// A wave amplitude x cos(2 pi frequency t + phase), t from the middle of the window.
  struct Wave {
    double frequency_hz = 0.0;
    double amplitude_mps2 = 0.0;
    double phase_rad = 0.0;
  };

 private:
  static constexpr std::size_t kWindow = 128;
  static constexpr std::size_t kHop = 25;

  [[nodiscard]] Wave strongest() const;
  [[nodiscard]] Wave wave_at(double frequency_hz, double mean) const;
  void take_crests(const Wave& wave, TimestampNs middle_ns, StepQueue& steps);

  StepConfig config_;
  std::array<double, kWindow> window_{};
  std::size_t seen_ = 0;
  std::optional<TimestampNs> last_step_;
  bool walking_ = false;
};

}  // namespace vpdr::pdr
