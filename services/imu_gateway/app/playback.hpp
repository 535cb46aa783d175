#pragma once
// The pace of a played recording: real time or a multiple of it, and never further ahead of the
// slowest awaited service than the window.
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "app/progress.hpp"
#include "core/time.hpp"

namespace vpdr::imu_gateway {

/// Holds each sample until it is due. wait() belongs to one thread, reports come from listeners.
class Playback {
 public:
  /// rate 0: no pace, only the window. Follows fusion, vision and recorder where they are waited
  /// for.
  Playback(app::ServiceContext& context, double rate, double window_s);

  /// Returns when a sample of this stamp may go out; false when asked to stop meanwhile.
  bool wait(TimestampNs stamp_ns, const std::stop_token& stop);
  /// Returns when every followed service is done with the sample of this stamp.
  bool wait_done(TimestampNs stamp_ns, const std::stop_token& stop);

 private:
  using Clock = std::chrono::steady_clock;
  bool wait_progress(TimestampNs stamp_ns, const std::stop_token& stop);
  bool reached(TimestampNs stamp_ns) const;
  void drop_lost();

  app::ServiceContext& context_;
  double rate_;
  TimestampNs window_ns_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<TimestampNs> first_ns_;
  Clock::time_point begin_;
  std::map<std::string, std::optional<TimestampNs>> progress_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Progress>> subscription_;
};

}  // namespace vpdr::imu_gateway
