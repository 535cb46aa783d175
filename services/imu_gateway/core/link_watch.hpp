#pragma once
// Why nothing usable comes through a port that is open: the board is mute, what it sends is not
// understood, or no acceleration is in it. Pure; belongs to one thread.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/time.hpp"
#include "imu_gateway/core/board_parser.hpp"

namespace vpdr::imu_gateway {

/// What is wrong with a source, and what to do about it.
struct LinkTrouble {
  std::string reason;
  std::string remedy;
};

class LinkWatch {
 public:
  /// The port was opened.
  void open(TimestampNs now_ns);
  /// Bytes came, maybe none.
  void see_bytes(std::size_t count, TimestampNs now_ns);
  /// A reading was understood; `inertial`: one with specific force.
  void see_reading(bool inertial, TimestampNs now_ns);

  /// None while inertial readings come, and in the first seconds. `device` is the port's name,
  /// `parser` knows what it could not read.
  [[nodiscard]] std::optional<LinkTrouble> trouble(std::string_view device,
                                                   const BoardParser& parser,
                                                   TimestampNs now_ns) const;

 private:
  TimestampNs last_bytes_ns_ = 0;
  TimestampNs last_reading_ns_ = 0;
  TimestampNs last_inertial_ns_ = 0;
};

}  // namespace vpdr::imu_gateway
