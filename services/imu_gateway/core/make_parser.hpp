#pragma once
// From the name of a protocol to its parser. Pure.
#include <memory>

#include "imu_gateway/core/board_parser.hpp"
#include "imu_gateway/core/line_parser.hpp"

namespace vpdr::imu_gateway {

enum class Protocol : std::uint8_t {
  kText,  ///< lines with the columns of LineFormat
  kXio,   ///< messages of x-io boards
  kWit,   ///< 0x55 frames of WitMotion boards
  kVpdr,  ///< docs/board_protocol.md
};

struct ParserOptions {
  Protocol protocol = Protocol::kText;
  LineFormat lines;  ///< of kText
  double wit_acceleration_range_g = 16.0;
  double wit_rate_range_dps = 2000.0;
  double field_unit_ut = 0.0;  ///< microtesla in one unit of kWit or kXio; 0: 0.1 and 50
};

std::unique_ptr<BoardParser> make_parser(const ParserOptions& options);

}  // namespace vpdr::imu_gateway
