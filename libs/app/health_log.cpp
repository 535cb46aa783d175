#include "app/health_log.hpp"

#include <cctype>

namespace vpdr::app {
namespace {

std::string words_of(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isalpha(c) == 0; });
  return text;
}

}  // namespace

std::optional<HealthLine> HealthLog::see(const Health& health) {
  const bool degraded = health.state == ServiceState::kDegraded;
  const std::string trouble = degraded ? words_of(health.reason) : "";
  if (trouble == trouble_) return std::nullopt;
  trouble_ = trouble;
  if (health.state == ServiceState::kRunning) return HealthLine{false, "running again"};
  if (!degraded) return std::nullopt;
  return HealthLine{true, health.reason + (health.remedy.empty() ? "" : ": " + health.remedy)};
}

}  // namespace vpdr::app
