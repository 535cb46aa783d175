#include "imu_gateway/app/playback.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace vpdr::imu_gateway {
namespace {

/// Progress is reported in steps of 20 ms; the last report may be one step short of the last
/// sample.
constexpr TimestampNs kReportSpacingNs = 40'000'000;
constexpr std::chrono::seconds kLookForLostEvery{1};
constexpr std::chrono::seconds kStandstillAfter{5};
/// A pause as long as this looks like a fault, unless it is said what it is.
constexpr std::chrono::seconds kSayHoleFrom{2};

double seconds(TimestampNs ns) { return static_cast<double>(ns) / 1e9; }

}  // namespace

Playback::Playback(app::ServiceContext& context, double rate, double window_s)
    : context_(context),
      rate_(rate),
      window_ns_(std::max(to_ns(window_s), kReportSpacingNs)),
      pdr_expected_(context.waits_for("pdr")) {
  for (const char* service : {"fusion", "vision", "recorder"}) {
    if (context.waits_for(service)) progress_[service] = std::nullopt;
  }
  subscription_ = context.subscribe(
      dds::topics::kProgress,
      [this](const vpdr_msgs::msg::Progress& message, const dds::SampleInfo&) { take(message); });
}

void Playback::take(const vpdr_msgs::msg::Progress& message) {
  const std::lock_guard lock(mutex_);
  if (message.service() == "pdr") pdr_expected_ = true;
  const auto found = progress_.find(message.service());
  if (found == progress_.end()) return;
  found->second = dds::from_msg(message.header().stamp());
  moved_ = Clock::now();
  standstill_.clear();
  changed_.notify_all();
}

bool Playback::wait(TimestampNs stamp_ns, const std::stop_token& stop) {
  wait_until_due(stamp_ns, stop);
  return wait_progress(window_ns_, stop);
}

void Playback::wait_until_due(TimestampNs stamp_ns, const std::stop_token& stop) {
  if (!first_ns_) {
    first_ns_ = stamp_ns;
    begin_ = Clock::now();
  }
  const TimestampNs hole_ns = stamp_ns - newest_ns_.value_or(stamp_ns);
  newest_ns_ = stamp_ns;
  if (rate_ <= 0.0) return;
  const auto due = begin_ + std::chrono::nanoseconds(static_cast<std::int64_t>(
                                static_cast<double>(stamp_ns - *first_ns_) / rate_));
  if (due - Clock::now() > kSayHoleFrom) {
    spdlog::info(
        "the recording has {:.1f} s without a sample; they take {:.1f} s at rate {}, none at "
        "rate 0",
        seconds(hole_ns), seconds(hole_ns) / rate_, rate_);
  }
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, stop, due, [] { return false; });
}

void Playback::sent(TimestampNs imu_stamp_ns) {
  const std::lock_guard lock(mutex_);
  if (!first_imu_ns_) first_imu_ns_ = imu_stamp_ns;
  last_imu_ns_ = imu_stamp_ns;
  seen_ns_ = imu_stamp_ns;
}

bool Playback::out_of_sight(TimestampNs stamp_ns) {
  if (stamp_ns - seen_ns_ <= window_ns_) return false;
  seen_ns_ = stamp_ns;
  return true;
}

bool Playback::wait_done(const std::stop_token& stop) {
  return wait_progress(kReportSpacingNs, stop);
}

bool Playback::wait_progress(TimestampNs lag_ns, const std::stop_token& stop) {
  const auto begin = Clock::now();
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (changed_.wait_for(lock, stop, kLookForLostEvery, [&] { return reached(lag_ns); })) {
      standstill_.clear();
      return true;
    }
    drop_lost();
    notice_standstill(begin);
  }
  return false;
}

bool Playback::reached(TimestampNs lag_ns) const {
  if (!first_imu_ns_) return true;
  return std::all_of(progress_.begin(), progress_.end(), [&](const auto& entry) {
    return entry.second.value_or(*first_imu_ns_) >= last_imu_ns_ - lag_ns;
  });
}

void Playback::drop_lost() {
  const auto is_present = [this](const std::string& service) {
    return context_.participant().wait_for_service(service, std::chrono::milliseconds(0));
  };
  std::erase_if(progress_, [&](const auto& entry) {
    const bool lost = !is_present(entry.first);
    if (lost) spdlog::warn("{} has left; the walk goes on without it", entry.first);
    return lost;
  });
  if (!pdr_expected_ || is_present("pdr")) return;
  // Fusion and vision pass pdr's progress on: alive or not, they have none without it.
  pdr_expected_ = false;
  progress_.erase("fusion");
  progress_.erase("vision");
  spdlog::warn("pdr has left: the walk goes on without it and waits for fusion and vision no more");
}

void Playback::notice_standstill(Clock::time_point begin) {
  if (!standstill_.empty() || Clock::now() - std::max(begin, moved_) < kStandstillAfter) return;
  standstill_ = laggards();
}

std::string Playback::laggards() const {
  std::string text;
  for (const auto& [service, done_ns] : progress_) {
    if (done_ns && *done_ns >= last_imu_ns_ - kReportSpacingNs) continue;
    text += (text.empty() ? "" : ", ") + service;
    text += done_ns ? fmt::format(" is done up to {:.3f} s", seconds(*done_ns))
                    : " has not reported yet";
  }
  return text;
}

void Playback::report(app::Health& health) {
  const std::lock_guard lock(mutex_);
  if (standstill_.empty()) return;
  health.degrade(
      fmt::format("the walk stands still at {:.3f} s: {}", seconds(last_imu_ns_), standstill_),
      "look at the services named");
}

}  // namespace vpdr::imu_gateway
