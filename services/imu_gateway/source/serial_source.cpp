#include "imu_gateway/source/serial_source.hpp"

#include <algorithm>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr std::chrono::milliseconds kLongestWait{100};
constexpr std::chrono::milliseconds kLongestPause{5000};
/// Waits without a port to wait on.
void idle(std::chrono::milliseconds duration) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable().wait_for(lock, duration, [] { return false; });
}

}  // namespace

SerialSource::SerialSource(SerialOptions options)
    : options_(std::move(options)),
      port_(SerialPort(options_.device, options_.baud)),
      parser_(make_parser(options_.parser)),
      stream_(options_.axes) {
  link_.open(options_.host_clock());
}

SampleSource::State SerialSource::next(Reading& out) {
  if (next_ready_ == ready_.size()) {
    ready_.clear();
    next_ready_ = 0;
    if (port_) {
      read_port();
    } else {
      reconnect();
    }
  }
  if (next_ready_ == ready_.size()) return State::kIdle;
  out = ready_[next_ready_++];
  return State::kReading;
}

SourceHealth SerialSource::health() const {
  SourceHealth health;
  health.connected = port_.has_value();
  if (auto trouble = port_ ? link_.trouble(options_.device, *parser_, options_.host_clock())
                           : std::optional(trouble_)) {
    health.reason = std::move(trouble->reason);
    health.remedy = std::move(trouble->remedy);
  }
  health.reconnections = reconnections_;
  health.parser = parser_->counts();
  health.stream = stream_.health();
  return health;
}

void SerialSource::read_port() {
  std::size_t count = 0;
  const auto outcome = port_->read(buffer_.data(), buffer_.size(), count);
  if (outcome == SerialPort::Outcome::kVanished) {
    lose_port();
    return;
  }
  const TimestampNs arrival_ns = options_.host_clock();
  parsed_.clear();
  parser_->feed(std::string_view(buffer_.data(), count), parsed_);
  link_.see_bytes(count, arrival_ns);
  for (const BoardReadings& readings : parsed_) {
    link_.see_reading(readings.specific_force_mps2.has_value(), arrival_ns);
    stream_.accept(readings, arrival_ns, ready_);
  }
}

void SerialSource::lose_port() {
  port_.reset();
  parser_->reset();
  stream_.restart();  // the board may restart with the plug
  trouble_ = {options_.device + " vanished",
              "plug the board in again: the stream goes on by itself"};
  retry_at_ns_ = 0;
  pause_ = std::chrono::milliseconds(100);
}

void SerialSource::reconnect() {
  const TimestampNs now = options_.host_clock();
  if (now < retry_at_ns_) {
    idle(std::min(pause_, kLongestWait));
    return;
  }
  try {
    port_.emplace(SerialPort(options_.device, options_.baud));
    ++reconnections_;
    link_.open(now);
  } catch (const DeviceFault& fault) {
    // There again, and cannot be opened: permissions, another program.
    if (std::filesystem::exists(options_.device)) trouble_.remedy = fault.what();
    retry_at_ns_ = now + std::chrono::nanoseconds(pause_).count();
    pause_ = std::min(pause_ * 2, kLongestPause);
  }
}

}  // namespace vpdr::imu_gateway
