#pragma once
// What the other services of the walker say of themselves.
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/health.hpp"
#include "dds/participant.hpp"
#include "dds/subscription.hpp"
#include "dds/topics.hpp"

namespace vpdr::app {

/// Follows the diagnostics and the presence of one walker's services. Of two instances of a service
/// the one that was heard first counts, as long as it is there. Thread-safe.
class PeerWatch {
 public:
  explicit PeerWatch(dds::Participant& participant);

  /// The last state the service gave; none before its first report.
  [[nodiscard]] std::optional<ServiceState> state_of(const std::string& service) const;
  /// Whether each is past waiting.
  [[nodiscard]] bool all_running(const std::vector<std::string>& services) const;
  /// Whether the service has been heard of and has since finished, or left without a word.
  [[nodiscard]] bool over(const std::string& service) const;
  /// Whether it left without saying that it had finished.
  [[nodiscard]] bool lost(const std::string& service) const;
  /// Services of the walker ever seen, by participant or by report; this one is not among them.
  [[nodiscard]] std::vector<std::string> seen() const;
  /// Takes note of who is on the network now; called at each turn of the service's loop.
  void refresh();

 private:
  /// What a service said last, and the writer it said it with.
  struct Report {
    dds::Guid writer{};
    ServiceState state = ServiceState::kWaiting;
  };

  void take(const diagnostic_msgs::msg::DiagnosticArray& message, const dds::Guid& writer);
  /// Whether another participant than this writer's speaks for the service.
  [[nodiscard]] bool spoken_for(const std::string& service, const dds::Guid& writer) const;

  dds::Participant& participant_;
  mutable std::mutex mutex_;
  std::map<std::string, Report> reports_;
  std::map<std::string, bool> present_;
  std::unique_ptr<dds::Subscription<diagnostic_msgs::msg::DiagnosticArray>> subscription_;
};

}  // namespace vpdr::app
