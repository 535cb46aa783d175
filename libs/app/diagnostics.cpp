#include "app/diagnostics.hpp"

#include "core/host_clock.hpp"
#include "dds/convert.hpp"

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
  dds::to_msg(host_now_ns(), message.header().stamp());
  message.status().push_back(std::move(status));
  return message;
}

}  // namespace vpdr::app
