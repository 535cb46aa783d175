#pragma once
// From what a board sends to samples on the host's clock in body axes. Pure; belongs to one thread.
#include <array>
#include <optional>
#include <vector>

#include "core/reading.hpp"
#include "imu_gateway/core/board_clock.hpp"
#include "imu_gateway/core/board_parser.hpp"
#include "imu_gateway/core/imu_pairing.hpp"
#include "imu_gateway/core/regular_clock.hpp"

namespace vpdr::imu_gateway {

/// Which way the sensors' axes point.
struct BoardAxes {
  Eigen::Matrix3d accelerometer = Eigen::Matrix3d::Identity();  ///< board to common axes
  Eigen::Matrix3d gyroscope = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d magnetometer = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d mount = Eigen::Matrix3d::Identity();  ///< common to body axes
};

/// What a board's stream is like, for diagnostics.
struct StreamHealth {
  ClockHealth clock;           ///< of a board with a clock
  std::uint64_t missing = 0;   ///< samples of a board without one, by the lateness of the others
  std::uint64_t bursts = 0;    ///< more than 20 ms of samples at one instant
  std::uint64_t unpaired = 0;  ///< angular rates without a specific force around them
  std::optional<double> temperature_c;  ///< the last one sent
  std::uint64_t odd_temperatures = 0;   ///< refused: no sensor of a worn board is so cold or hot
};

/// Stamps and turns readings. One clock serves all sensors of a board that has one; without, each
/// kind of message has a regular clock of its own.
class BoardStream {
 public:
  explicit BoardStream(const BoardAxes& axes) : axes_(axes) {}

  /// Appends the samples of one message seen at `arrival_ns`, or of one before that waited for it.
  void accept(const BoardReadings& readings, TimestampNs arrival_ns, std::vector<Reading>& out);
  /// The same with the board's stamps as they are; there must be one.
  void accept_as_stamped(const BoardReadings& readings, std::vector<Reading>& out);
  /// As after a reconnection: the board may have restarted, or be another one.
  void restart();
  [[nodiscard]] StreamHealth health() const;

 private:
  std::optional<TimestampNs> stamp_of(const BoardReadings& readings, TimestampNs arrival_ns);
  void emit(const BoardReadings& readings, TimestampNs stamp_ns, std::vector<Reading>& out);
  void accept_inertial(const BoardReadings& readings, TimestampNs stamp_ns,
                       std::vector<Reading>& out);
  void take_temperature(double celsius);
  void watch_bursts(TimestampNs stamp_ns, TimestampNs arrival_ns);

  /// Sixteen kinds of message by what they hold: force, rate, field, pressure.
  static constexpr std::size_t kKinds = 16;
  BoardAxes axes_;
  BoardClock clock_;
  std::array<RegularClock, kKinds> regular_clocks_;
  ImuPairing pairing_;
  bool gyroscope_is_apart_ = false;
  std::vector<ImuSample> paired_;
  std::optional<double> temperature_c_;
  std::uint64_t odd_temperatures_ = 0;
  std::uint64_t bursts_ = 0;
  TimestampNs burst_arrival_ns_ = 0;
  TimestampNs burst_begin_ns_ = 0;
  bool burst_is_counted_ = false;
};

}  // namespace vpdr::imu_gateway
