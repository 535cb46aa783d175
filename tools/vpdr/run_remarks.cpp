#include "vpdr/run_remarks.hpp"

#include <optional>
#include <variant>

#include "core/reading.hpp"
#include "core/sample_gate.hpp"
#include "imu_gateway/core/startup_checks.hpp"
#include "pdr/core/carry.hpp"
#include "vision/core/frame_check.hpp"

namespace vpdr::tool {
namespace {

/// "3 dark, 1 blurred".
class Counts {
 public:
  void add(std::uint64_t count, const char* name) {
    if (count == 0) return;
    text_ += (text_.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    sum_ += count;
  }
  [[nodiscard]] std::uint64_t sum() const { return sum_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::uint64_t sum_ = 0;
};

std::optional<std::string> unused(const char* sensor, const SampleGate& gate) {
  Counts refused;
  for (const Refusal reason : kRefusals) refused.add(gate.refused(reason), name_of(reason));
  if (gate.accepted() > 0 || refused.sum() == 0) return std::nullopt;
  return std::string(sensor) + ": 0 of " + std::to_string(refused.sum()) +
         " readings used: " + refused.text() + "; check the unit";
}

/// No images of the world; in the others there may be no corridor.
bool is_refusal(vision::FrameOutcome outcome) {
  return outcome > vision::FrameOutcome::kFound && outcome < vision::FrameOutcome::kFewLines;
}

std::optional<std::string> refused_frames(const vision::VanishingPointHeading& heading) {
  Counts refused;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < vision::kFrameOutcomeCount; ++i) {
    const auto outcome = static_cast<vision::FrameOutcome>(i);
    all += heading.count(outcome);
    if (is_refusal(outcome)) refused.add(heading.count(outcome), vision::name_of(outcome));
  }
  if (refused.sum() == 0) return std::nullopt;
  return "vision: " + std::to_string(refused.sum()) + " of " + std::to_string(all) +
         " frames refused: " + refused.text();
}

}  // namespace

std::vector<std::string> sensor_remarks(const dataset::Recording& recording) {
  imu_gateway::StartupChecks checks;
  for (const Reading& reading : merge_by_stamp(recording.imu, recording.mag, {})) {
    if (const auto* imu = std::get_if<ImuSample>(&reading)) checks.see(*imu);
    if (const auto* mag = std::get_if<MagSample>(&reading)) checks.see(*mag);
  }
  std::vector<std::string> remarks;
  for (const auto& finding : checks.findings()) {
    remarks.push_back(finding.what + "; " + finding.remedy);
  }
  return remarks;
}

std::vector<std::string> about_remarks(const dataset::About& about) {
  if (about.carry.empty() || pdr::carry_named(about.carry) != pdr::Carry::kUnknown) return {};
  return {"about.yaml: carry '" + about.carry +
          "' names none of hand, pocket, waist, chest, head: taken as unknown, which serves all"};
}

std::vector<std::string> unused_remarks(const Pipeline& pipeline) {
  const pdr::Pdr& pdr = pipeline.pdr();
  std::vector<std::string> remarks;
  for (auto remark :
       {unused("inertial sensor", pdr.imu_gate()), unused("magnetometer", pdr.mag_gate()),
        unused("barometer", pdr.pressure_gate()),
        pipeline.vision() ? refused_frames(pipeline.vision()->heading()) : std::nullopt}) {
    if (remark) remarks.push_back(std::move(*remark));
  }
  return remarks;
}

}  // namespace vpdr::tool
