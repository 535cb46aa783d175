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

#include "app/health.hpp"
#include "app/progress.hpp"
#include "core/time.hpp"

namespace vpdr::imu_gateway {

/// Holds each sample until it is due. wait(), sent() and wait_done() belong to one thread, reports
/// come from listeners, report() may be called by any.
class Playback {
 public:
  /// rate 0: no pace, only the window. Follows fusion, vision and recorder where they are waited
  /// for.
  Playback(app::ServiceContext& context, double rate, double window_s);

  /// Returns when a sample of this stamp may go out; false when asked to stop meanwhile.
  bool wait(TimestampNs stamp_ns, const std::stop_token& stop);
  /// An inertial sample has gone out. Services report by the stamps of these alone, so the window
  /// is counted back from the last one, not from the next sample: nobody can report into a hole.
  void sent(TimestampNs imu_stamp_ns);
  /// Whether the window's worth of samples has gone out that no service reports on: those of the
  /// other sensors where there are no inertial ones. True once for each window.
  bool out_of_sight(TimestampNs stamp_ns);
  /// Returns when every followed service is done with the last inertial sample.
  bool wait_done(const std::stop_token& stop);

  /// Degraded while the walk stands still.
  void report(app::Health& health);

 private:
  using Clock = std::chrono::steady_clock;
  void take(const vpdr_msgs::msg::Progress& message);
  void wait_until_due(TimestampNs stamp_ns, const std::stop_token& stop);
  bool wait_progress(TimestampNs lag_ns, const std::stop_token& stop);
  /// Whether no followed service is further than `lag_ns` behind the last inertial sample.
  bool reached(TimestampNs lag_ns) const;
  void drop_lost();
  void notice_standstill(Clock::time_point begin);
  std::string laggards() const;

  app::ServiceContext& context_;
  double rate_;
  TimestampNs window_ns_;
  std::optional<TimestampNs> first_ns_;
  std::optional<TimestampNs> newest_ns_;  ///< stamp of the sample that was last due
  TimestampNs seen_ns_ = 0;  ///< last inertial sample, or where out_of_sight() was last true
  Clock::time_point begin_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::optional<TimestampNs> first_imu_ns_;
  TimestampNs last_imu_ns_ = 0;
  std::map<std::string, std::optional<TimestampNs>> progress_;
  bool pdr_expected_;        ///< awaited, or heard of
  Clock::time_point moved_;  ///< when a followed service last reported
  std::string standstill_;   ///< who is waited for; empty: the walk goes on
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Progress>> subscription_;
};

}  // namespace vpdr::imu_gateway
