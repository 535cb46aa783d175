#pragma once
// The life of a service between start-up and exit: matching, diagnostics, the end of the walk.
#include <chrono>
#include <optional>

#include "app/health_log.hpp"
#include "app/peer_watch.hpp"
#include "app/service.hpp"
#include "diagnostic_msgs.h"

namespace vpdr::app {

/// Throws DdsFault where this service runs already for this walker.
void refuse_second_instance(const dds::Participant& participant);

/// Runs in the main thread; the service's own threads and listeners do the work.
class ServiceLoop {
 public:
  ServiceLoop(ServiceContext& context, Service& service);
  /// Returns when the service is to leave. Throws DdsFault for a second instance of the service.
  ExitCode run();

 private:
  using Clock = std::chrono::steady_clock;

  /// Waits a moment for SIGINT or SIGTERM.
  static bool signalled();
  void report_problems();
  void advance_start();
  [[nodiscard]] bool walk_over();
  void publish_health(ServiceState at_least);
  ExitCode leave();

  ServiceContext& context_;
  Service& service_;
  std::unique_ptr<dds::Publisher<diagnostic_msgs::msg::DiagnosticArray>> diagnostics_;
  PeerWatch peers_;
  HealthLog health_log_;
  bool matched_ = false;
  bool started_ = false;
  Clock::time_point next_report_ = Clock::now();
  std::optional<Clock::time_point> waiting_since_;
};

}  // namespace vpdr::app
