#pragma once
// What a service says of itself once a second on the topic diagnostics.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/sample_gate.hpp"

namespace vpdr::app {

/// State of a service, as its peers and people read it.
enum class ServiceState : std::uint8_t {
  kWaiting,   ///< not matched yet with the services it was told to wait for
  kRunning,   ///< at work
  kDegraded,  ///< at work, but something is wrong: reason and remedy say what
  kFinished,  ///< the walk is over and everything is handed on
};

/// "waiting", "running", "degraded", "finished".
const char* name_of(ServiceState state);

/// One report. Filled anew each second by Service::report.
struct Health {
  ServiceState state = ServiceState::kRunning;
  std::string reason;  ///< what is wrong, empty when nothing is
  std::string remedy;  ///< what to do about it
  std::vector<std::pair<std::string, std::string>> counters;

  /// Marks the service degraded. The first reason stays.
  void degrade(const std::string& why, const std::string& what_to_do);
  void count(const std::string& name, std::uint64_t value);
  void note(const std::string& name, const std::string& value);
  /// "<stream>.refused.<reason>" for every reason. `gate.refused(reason)` gives the counts.
  template <class Gate>
  void count_refusals(const std::string& stream, const Gate& gate) {
    for (const Refusal refusal : kRefusals) {
      count(stream + ".refused." + vpdr::name_of(refusal), gate.refused(refusal));
    }
  }
};

}  // namespace vpdr::app
