#include "app/diagnostics.hpp"

#include <chrono>

namespace vpdr::app {
namespace {

// Levels of diagnostic_msgs/DiagnosticStatus.
constexpr std::uint8_t kOk = 0;
constexpr std::uint8_t kWarn = 1;

diagnostic_msgs::msg::KeyValue pair_of(const std::string& key, const std::string& value) {
  diagnostic_msgs::msg::KeyValue pair;
  pair.key(key);
  pair.value(value);
  return pair;
}

}  // namespace

diagnostic_msgs::msg::DiagnosticArray to_diagnostics(const Health& health,
                                                     const std::string& service,
                                                     const std::string& walker) {
  diagnostic_msgs::msg::DiagnosticStatus status;
  status.level(health.state == ServiceState::kDegraded ? kWarn : kOk);
  status.name(service);
  status.hardware_id(walker);
  const std::string state = name_of(health.state);
  status.message(health.reason.empty() ? state : state + ": " + health.reason);
  status.values().push_back(pair_of("state", state));
  status.values().push_back(pair_of("reason", health.reason));
  status.values().push_back(pair_of("remedy", health.remedy));
  for (const auto& [key, value] : health.counters) status.values().push_back(pair_of(key, value));

  diagnostic_msgs::msg::DiagnosticArray message;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  message.header().stamp().sec(static_cast<std::int32_t>(ns / 1'000'000'000));
  message.header().stamp().nanosec(static_cast<std::uint32_t>(ns % 1'000'000'000));
  message.status().push_back(std::move(status));
  return message;
}

}  // namespace vpdr::app
