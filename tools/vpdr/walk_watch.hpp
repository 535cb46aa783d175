#pragma once
// What people see of a walk of five processes: how far it is, and what its services complain of.
#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "app/health_log.hpp"
#include "core/time.hpp"
#include "dds/participant.hpp"
#include "dds/subscription.hpp"
#include "diagnostic_msgs.h"
#include "vpdr/progress_bar.hpp"
#include "vpdr_msgs.h"

namespace vpdr::tool {

/// Follows the topics playback/progress and diagnostics.
class WalkWatch {
 public:
  /// The walk's stamps go from `begin_ns` to `end_ns`; a live one, whose end nobody knows, has 0.
  WalkWatch(const dds::ParticipantOptions& options, TimestampNs begin_ns, TimestampNs end_ns);

  /// Draws what is new on standard error. Whether the walk has begun.
  bool draw();

 private:
  void hear(const diagnostic_msgs::msg::DiagnosticArray& message);

  TimestampNs begin_ns_;
  TimestampNs end_ns_;
  ProgressBar bar_;
  bool told_ = false;  ///< how to look at a live walk
  std::atomic<TimestampNs> stamp_ns_{0};
  std::atomic<bool> began_{false};
  std::mutex mutex_;  ///< guards what follows
  std::map<std::string, app::HealthLog> troubles_;
  std::vector<std::string> lines_;  ///< not shown yet
  dds::Participant participant_;
  dds::Subscription<vpdr_msgs::msg::Progress> progress_;
  dds::Subscription<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
};

}  // namespace vpdr::tool
