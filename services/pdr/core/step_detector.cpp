#include "pdr/core/step_detector.hpp"

namespace vpdr::pdr {

StepDetector::StepDetector(const StepConfig& config, Carry carry)
    : signal_(config.gap_s), detector_(make(config, carry)) {}

StepDetector::Detector StepDetector::make(const StepConfig& config, Carry carry) {
  switch (config.detector) {
    case DetectorKind::kPeaks:
      return PeakStepDetector(config);
    case DetectorKind::kSwing:
      return SwingStepDetector(config);
    case DetectorKind::kSpectrum:
      return SpectrumStepDetector(config);
    case DetectorKind::kGait:
      break;
  }
  return GaitStepDetector(config, on_trunk(carry));
}

void StepDetector::add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
                       const Eigen::Vector3d& angular_velocity_radps) {
  if (!signal_.add(stamp_ns, specific_force_mps2, angular_velocity_radps)) {
    std::visit([this](auto& detector) { detector.restart(steps_); }, detector_);
  }
  while (const auto value = signal_.take()) {
    std::visit([&](auto& detector) { detector.add(*value, steps_); }, detector_);
  }
}

bool StepDetector::walking() const {
  return std::visit([](const auto& detector) { return detector.walking(); }, detector_);
}

}  // namespace vpdr::pdr
