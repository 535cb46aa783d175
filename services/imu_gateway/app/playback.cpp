#include "imu_gateway/app/playback.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace vpdr::imu_gateway {
namespace {

/// Progress is reported in steps of 20 ms; the last report may be one step short of the last
/// sample.
constexpr TimestampNs kReportSpacingNs = 40'000'000;
constexpr std::chrono::seconds kLookForLostEvery{1};

}  // namespace

Playback::Playback(app::ServiceContext& context, double rate, double window_s)
    : context_(context), rate_(rate), window_ns_(to_ns(window_s)) {
  for (const char* service : {"fusion", "vision", "recorder"}) {
    if (context.waits_for(service)) progress_[service] = std::nullopt;
  }
  subscription_ =
      context.subscribe(dds::topics::kProgress,
                        [this](const vpdr_msgs::msg::Progress& message, const dds::SampleInfo&) {
                          const std::lock_guard lock(mutex_);
                          const auto found = progress_.find(message.service());
                          if (found == progress_.end()) return;
                          found->second = dds::from_msg(message.header().stamp());
                          changed_.notify_all();
                        });
}

bool Playback::wait(TimestampNs stamp_ns, const std::stop_token& stop) {
  if (!first_ns_) {
    first_ns_ = stamp_ns;
    begin_ = Clock::now();
  }
  if (rate_ > 0.0) {
    const auto due = begin_ + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                  static_cast<double>(stamp_ns - *first_ns_) / rate_));
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, stop, due, [] { return false; });
  }
  return wait_progress(stamp_ns - window_ns_, stop);
}

bool Playback::wait_done(TimestampNs stamp_ns, const std::stop_token& stop) {
  return wait_progress(stamp_ns - kReportSpacingNs, stop);
}

bool Playback::wait_progress(TimestampNs stamp_ns, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (changed_.wait_for(lock, stop, kLookForLostEvery, [&] { return reached(stamp_ns); })) {
      return true;
    }
    drop_lost();
  }
  return false;
}

bool Playback::reached(TimestampNs stamp_ns) const {
  return std::all_of(progress_.begin(), progress_.end(), [&](const auto& entry) {
    return entry.second.value_or(*first_ns_) >= stamp_ns;
  });
}

void Playback::drop_lost() {
  const auto& options = context_.participant().options();
  const auto peers = context_.participant().remote_participants();
  std::erase_if(progress_, [&](const auto& entry) {
    const bool present = std::any_of(peers.begin(), peers.end(), [&](const auto& peer) {
      return peer.walker == options.walker && peer.service == entry.first;
    });
    if (!present) spdlog::warn("{} has left; the walk goes on without it", entry.first);
    return !present;
  });
}

}  // namespace vpdr::imu_gateway
