#pragma once
// The one main of every service.
#include "app/service.hpp"

namespace vpdr::app {

/// Reads command line, environment and YAML, joins the domain, runs the service until SIGINT,
/// SIGTERM, the end of the walk (--until-end) or a fault, and closes it in order. Returns the exit
/// code of docs/operations.md; start-up faults are printed as one line each on standard error.
int run_service(const ServiceEntry& entry, int argc, char** argv);

}  // namespace vpdr::app
