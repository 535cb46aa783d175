#pragma once
// S1.12: a step is where the norm of specific force swings by more than a threshold,
// |a_max - a_min| > threshold: down from a maximum
// after it rose from a minimum by as much. No filter but a mean over 0.1 s; the minimum interval
// keeps the ringing of a heel strike from counting twice.
#include <array>
#include <optional>

#include "pdr/core/steps/detected_step.hpp"
#include "pdr/core/steps/step_config.hpp"
#include "pdr/core/steps/step_signal.hpp"

namespace vpdr::pdr {

class SwingStepDetector {
 public:
  explicit SwingStepDetector(const StepConfig& config) : config_(config) {}

  void restart(StepQueue& /*steps*/) { *this = SwingStepDetector(config_); }
  void add(const SignalValue& value, StepQueue& steps);
  [[nodiscard]] bool walking() const { return walking_; }

 private:
  static constexpr std::size_t kMean = 5;  ///< values in the running mean

  void rise(TimestampNs stamp_ns, double norm, StepQueue& steps);
  void fall(double norm);
  void take_step(StepQueue& steps);

  StepConfig config_;
  std::array<double, kMean> recent_{};
  std::size_t seen_ = 0;
  bool rising_ = true;  ///< looking for the maximum
  double minimum_ = 0.0;
  double maximum_ = 0.0;
  TimestampNs maximum_ns_ = 0;
  std::optional<TimestampNs> last_step_;
  bool walking_ = false;
};

}  // namespace vpdr::pdr
