#pragma once
// Health reports as diagnostic_msgs.
#include <string>

#include "app/health.hpp"
#include "diagnostic_msgs.h"

namespace vpdr::app {

/// One status: name = service, hardware_id = walker, values: state, reason, remedy, the counters.
diagnostic_msgs::msg::DiagnosticArray to_diagnostics(const Health& health,
                                                     const std::string& service,
                                                     const std::string& walker);

}  // namespace vpdr::app
