#pragma once
// A board on a serial port, whatever protocol it speaks.
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "imu_gateway/core/board_stream.hpp"
#include "imu_gateway/core/link_watch.hpp"
#include "imu_gateway/core/make_parser.hpp"
#include "imu_gateway/source/sample_source.hpp"
#include "imu_gateway/source/serial_port.hpp"

namespace vpdr::imu_gateway {

/// How the board is reached, what it speaks and which way its axes point.
struct SerialOptions {
  std::string device;
  std::uint32_t baud = 115200;
  ParserOptions parser;
  BoardAxes axes;
  std::function<TimestampNs()> host_clock;  ///< nanoseconds since the epoch
};

/// Reads the board, stamps what it sends and turns its axes. A port that vanishes is opened again
/// and again with growing pauses; what the board sends then goes on in the same stream.
class SerialSource : public SampleSource {
 public:
  /// Throws DeviceFault where the port cannot be opened at first.
  explicit SerialSource(SerialOptions options);

  State next(Reading& out) override;
  [[nodiscard]] SourceHealth health() const override;

 private:
  void read_port();
  void lose_port();
  void reconnect();

  SerialOptions options_;
  std::optional<SerialPort> port_;
  std::unique_ptr<BoardParser> parser_;
  BoardStream stream_;
  std::vector<BoardReadings> parsed_;
  std::vector<Reading> ready_;
  std::size_t next_ready_ = 0;
  std::array<char, 4096> buffer_{};
  std::chrono::milliseconds pause_{100};
  TimestampNs retry_at_ns_ = 0;
  LinkTrouble trouble_;  ///< why there is no port
  LinkWatch link_;       ///< of the open one
  std::uint64_t reconnections_ = 0;
};

}  // namespace vpdr::imu_gateway
