#pragma once
// Where samples come from: a recording, the simulator or a board on a serial port.
#include <cstdint>
#include <string>

#include "core/reading.hpp"
#include "imu_gateway/core/board_parser.hpp"
#include "imu_gateway/core/board_stream.hpp"

namespace vpdr::imu_gateway {

/// What a source can say of itself in diagnostics.
struct SourceHealth {
  bool connected = true;
  std::string reason;  ///< why nothing usable comes; empty: nothing is wrong
  std::string remedy;  ///< what to do about it
  std::uint64_t reconnections = 0;
  ParserCounts parser;
  StreamHealth stream;
};

/// One stream of readings in body axes. Used by one thread.
class SampleSource {
 public:
  enum class State : std::uint8_t {
    kReading,  ///< `out` holds the next reading
    kIdle,     ///< nothing within the waiting time; ask again
    kEnded,    ///< nothing will come any more
  };

  virtual ~SampleSource() = default;
  /// Waits for at most a tenth of a second, so that shut-down is never held up.
  virtual State next(Reading& out) = 0;
  [[nodiscard]] virtual SourceHealth health() const = 0;
};

}  // namespace vpdr::imu_gateway
