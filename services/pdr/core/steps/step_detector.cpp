#include "pdr/core/steps/step_detector.hpp"

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
  if (signal_.is_silent_before(stamp_ns)) pass_silence(stamp_ns);
  if (!signal_.add(stamp_ns, specific_force_mps2, angular_velocity_radps)) {
    std::visit([this](auto& detector) { detector.restart(steps_); }, detector_);
  }
  while (const auto value = signal_.take()) {
    std::visit([&](auto& detector) { detector.add(*value, steps_); }, detector_);
  }
}

/// Whoever walks before a short silence walks on in it; the documents' detectors, which know no
/// walk, see a straight line.
void StepDetector::pass_silence(TimestampNs stamp_ns) {
  auto* gait = std::get_if<GaitStepDetector>(&detector_);
  const std::optional<double> stride_s = gait != nullptr ? gait->stride_s() : std::nullopt;
  if (!stride_s) return;
  while (const auto value = signal_.go_on(stamp_ns, *stride_s)) gait->add(*value, steps_);
}

bool StepDetector::walking() const {
  return std::visit([](const auto& detector) { return detector.walking(); }, detector_);
}

}  // namespace vpdr::pdr
