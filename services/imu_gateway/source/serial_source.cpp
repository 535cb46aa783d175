#include "imu_gateway/source/serial_source.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr int kPollMs = 100;
constexpr std::chrono::milliseconds kLongestPause{5000};
/// A board clock that steps back further than this has restarted.
constexpr TimestampNs kClockResetNs = kNsPerSecond / 2;

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
      parser_(make_parser(options_.parser)) {}

SampleSource::State SerialSource::next(Reading& out) {
  if (ready_.empty()) {
    if (port_) {
      read_port();
    } else {
      reconnect();
    }
  }
  if (ready_.empty()) return State::kIdle;
  out = ready_.front();
  ready_.pop_front();
  return State::kReading;
}

void SerialSource::read_port() {
  std::size_t count = 0;
  const auto outcome = port_->read(buffer_.data(), buffer_.size(), kPollMs, count);
  if (outcome == SerialPort::Outcome::kVanished) {
    port_.reset();
    parser_->reset();
    health_.connected = false;
    health_.reason = options_.device + " vanished; plug the board in again, it is tried for";
    retry_at_ns_ = 0;
    pause_ = std::chrono::milliseconds(100);
    return;
  }
  parsed_.clear();
  parser_->feed(std::string_view(buffer_.data(), count), parsed_);
  health_.parser = parser_->counts();
  for (const BoardReadings& readings : parsed_) accept(readings);
}

void SerialSource::reconnect() {
  const TimestampNs now = options_.host_clock();
  if (now < retry_at_ns_) {
    idle(std::min(pause_, std::chrono::milliseconds(kPollMs)));
    return;
  }
  try {
    port_.emplace(SerialPort(options_.device, options_.baud));
    ++health_.reconnections;
    health_.connected = true;
    health_.reason.clear();
    offset_ns_.reset();  // the board may have restarted with the plug
  } catch (const DeviceFault& fault) {
    health_.reason = fault.what();
    retry_at_ns_ = now + std::chrono::nanoseconds(pause_).count();
    pause_ = std::min(pause_ * 2, kLongestPause);
  }
}

void SerialSource::accept(const BoardReadings& readings) {
  const TimestampNs stamp = host_stamp(readings.board_stamp_ns);
  if (readings.temperature_c) health_.temperature_c = readings.temperature_c;
  if (readings.field_ut) {
    ready_.emplace_back(
        MagSample{stamp, options_.mount * options_.magnetometer_axes * *readings.field_ut});
  }
  if (readings.pressure_pa) ready_.emplace_back(PressureSample{stamp, *readings.pressure_pa});
  if (readings.specific_force_mps2) {
    ImuSample imu;
    imu.stamp_ns = stamp;
    imu.specific_force_mps2 =
        options_.mount * options_.accelerometer_axes * *readings.specific_force_mps2;
    imu.has_angular_velocity = readings.angular_velocity_radps.has_value();
    if (imu.has_angular_velocity) {
      imu.angular_velocity_radps =
          options_.mount * options_.gyroscope_axes * *readings.angular_velocity_radps;
    }
    ready_.emplace_back(imu);
  }
}

TimestampNs SerialSource::host_stamp(std::optional<TimestampNs> board_stamp_ns) {
  const TimestampNs now = options_.host_clock();
  if (!board_stamp_ns) return now;
  const bool reset = offset_ns_ && *board_stamp_ns < last_board_ns_ - kClockResetNs;
  if (reset) ++health_.clock_resets;
  // The least offset seen belongs to the line that waited least on its way.
  const TimestampNs offset = now - *board_stamp_ns;
  if (!offset_ns_ || reset || offset < *offset_ns_) offset_ns_ = offset;
  last_board_ns_ = *board_stamp_ns;
  return *board_stamp_ns + *offset_ns_;
}

}  // namespace vpdr::imu_gateway
