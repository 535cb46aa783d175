#pragma once
// A board on a serial port, whatever protocol it speaks.
#include <Eigen/Core>
#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "imu_gateway/core/make_parser.hpp"
#include "imu_gateway/source/sample_source.hpp"
#include "imu_gateway/source/serial_port.hpp"

namespace vpdr::imu_gateway {

/// How the board is reached, what it speaks and which way its axes point.
struct SerialOptions {
  std::string device;
  std::uint32_t baud = 115200;
  ParserOptions parser;
  Eigen::Matrix3d accelerometer_axes = Eigen::Matrix3d::Identity();  ///< board to common axes
  Eigen::Matrix3d gyroscope_axes = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d magnetometer_axes = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d mount = Eigen::Matrix3d::Identity();  ///< common to body axes
  std::function<TimestampNs()> host_clock;              ///< nanoseconds since the epoch
};

/// Reads the board, stamps what it sends and turns its axes. A port that vanishes is opened again
/// and again with growing pauses; what the board sends then goes on in the same stream.
class SerialSource : public SampleSource {
 public:
  /// Throws DeviceFault where the port cannot be opened at first.
  explicit SerialSource(SerialOptions options);

  State next(Reading& out) override;
  [[nodiscard]] SourceHealth health() const override { return health_; }

 private:
  void read_port();
  void reconnect();
  void accept(const BoardReadings& readings);
  TimestampNs host_stamp(std::optional<TimestampNs> board_stamp_ns);

  SerialOptions options_;
  std::optional<SerialPort> port_;
  std::unique_ptr<BoardParser> parser_;
  std::vector<BoardReadings> parsed_;
  std::deque<Reading> ready_;
  std::array<char, 4096> buffer_{};
  std::optional<TimestampNs> offset_ns_;  ///< host minus board clock
  TimestampNs last_board_ns_ = 0;
  std::chrono::milliseconds pause_{100};
  TimestampNs retry_at_ns_ = 0;
  SourceHealth health_;
};

}  // namespace vpdr::imu_gateway
