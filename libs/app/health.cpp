#include "app/health.hpp"

namespace vpdr::app {

const char* name_of(ServiceState state) {
  switch (state) {
    case ServiceState::kWaiting:
      return "waiting";
    case ServiceState::kRunning:
      return "running";
    case ServiceState::kDegraded:
      return "degraded";
    case ServiceState::kFinished:
      return "finished";
  }
  return "unknown";
}

void Health::degrade(const std::string& why, const std::string& what_to_do) {
  if (state == ServiceState::kDegraded) return;
  state = ServiceState::kDegraded;
  reason = why;
  remedy = what_to_do;
}

void Health::count(const std::string& name, std::uint64_t value) {
  counters.emplace_back(name, std::to_string(value));
}

void Health::note(const std::string& name, const std::string& value) {
  counters.emplace_back(name, value);
}

}  // namespace vpdr::app
