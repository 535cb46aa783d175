#include "imu_gateway/core/make_parser.hpp"

#include "imu_gateway/core/frame_parser.hpp"
#include "imu_gateway/core/wit_parser.hpp"

namespace vpdr::imu_gateway {
namespace {

/// x-IMU3 boards give the field in units of the field where they were calibrated.
constexpr double kXioFieldUnit_ut = 50.0;

}  // namespace

std::unique_ptr<BoardParser> make_parser(const ParserOptions& options) {
  switch (options.protocol) {
    case Protocol::kText:
      return std::make_unique<TextParser>(options.lines);
    case Protocol::kXio:
      return std::make_unique<TextParser>(
          xio_format(options.field_unit_ut > 0.0 ? options.field_unit_ut : kXioFieldUnit_ut));
    case Protocol::kWit: {
      WitOptions wit;
      wit.acceleration_range_g = options.wit_acceleration_range_g;
      wit.rate_range_dps = options.wit_rate_range_dps;
      if (options.field_unit_ut > 0.0) wit.field_unit_ut = options.field_unit_ut;
      return std::make_unique<WitParser>(wit);
    }
    case Protocol::kVpdr:
      return std::make_unique<FrameParser>();
  }
  return nullptr;
}

}  // namespace vpdr::imu_gateway
