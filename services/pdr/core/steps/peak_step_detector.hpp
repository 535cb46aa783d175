#pragma once
// S3.1: a step is a peak of the filtered norm of specific force, higher than a threshold and at
// least a minimum interval after the one before. Every such peak counts, whatever made it.
#include <array>
#include <optional>

#include "pdr/core/steps/detected_step.hpp"
#include "pdr/core/steps/drift_free_low_pass.hpp"
#include "pdr/core/steps/step_signal.hpp"

namespace vpdr::pdr {

class PeakStepDetector {
 public:
  explicit PeakStepDetector(const StepConfig& config) : config_(config), filter_(config) {}

  void restart(StepQueue& /*steps*/) { *this = PeakStepDetector(config_); }
  void add(const SignalValue& value, StepQueue& steps);
  [[nodiscard]] bool walking() const { return walking_; }

 private:
  StepConfig config_;
  DriftFreeLowPass filter_;
  std::array<double, 3> last_{};  ///< newest first
  double valley_ = 0.0;
  std::optional<TimestampNs> last_step_;
  bool walking_ = false;
};

}  // namespace vpdr::pdr
