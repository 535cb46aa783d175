#pragma once
// Steps from specific force, by one of four detectors (StepConfig::detector): the default, which
// knows a walk, and the three ways of the source documents. All of them look at the norm, so none
// minds how the board is held. Only the default gives tentative steps.
//
// The AHRS paper's minimum interval of 0.75 s cannot give the 1.53 and 1.71 steps/s of its own
// table; it is configurable and shorter. SI. Not thread-safe; allocates nothing.
//
//   StepDetector detector(StepConfig{});
//   detector.add(stamp_ns, specific_force, angular_velocity);
//   while (const auto step = detector.take()) use(*step);
#include <Eigen/Core>
#include <optional>
#include <variant>

#include "core/time.hpp"
#include "pdr/core/carry.hpp"
#include "pdr/core/steps/detected_step.hpp"
#include "pdr/core/steps/gait_step_detector.hpp"
#include "pdr/core/steps/peak_step_detector.hpp"
#include "pdr/core/steps/spectrum_step_detector.hpp"
#include "pdr/core/steps/step_config.hpp"
#include "pdr/core/steps/step_signal.hpp"
#include "pdr/core/steps/swing_step_detector.hpp"

namespace vpdr::pdr {

class StepDetector {
 public:
  explicit StepDetector(const StepConfig& config = {}, Carry carry = Carry::kUnknown);

  /// Specific force and angular velocity (zero where unknown), any axes. Stamps increase.
  void add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
           const Eigen::Vector3d& angular_velocity_radps);
  /// The oldest word that was not taken yet.
  std::optional<DetectedStep> take() { return steps_.take(); }

  /// True while steps follow one another.
  [[nodiscard]] bool walking() const;

 private:
  using Detector =
      std::variant<GaitStepDetector, PeakStepDetector, SwingStepDetector, SpectrumStepDetector>;
  static Detector make(const StepConfig& config, Carry carry);
  void pass_silence(TimestampNs stamp_ns);

  StepSignal signal_;
  Detector detector_;
  StepQueue steps_;
};

}  // namespace vpdr::pdr
