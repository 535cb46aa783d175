#include "imu_gateway/core/link_watch.hpp"

#include <algorithm>

namespace vpdr::imu_gateway {
namespace {

/// Longer than boot loaders talk and slow boards pause.
constexpr TimestampNs kPatienceNs = 3 * kNsPerSecond;

bool is_text(std::string_view line) {
  return !line.empty() && std::all_of(line.begin(), line.end(),
                                      [](char c) { return c == '\t' || (c >= ' ' && c <= '~'); });
}

LinkTrouble not_understood(const std::string& device, const BoardParser& parser) {
  const std::string_view line = parser.last_refused();
  if (!is_text(line)) {
    return {"what " + device + " sends is not understood",
            "set imu_gateway.serial.baud and imu_gateway.serial.protocol as the board has them"};
  }
  return {"what " + device + " sends is not understood, as `" + std::string(line) + "`",
          "name the columns of such lines in imu_gateway.serial.lines, one name for each, as "
          "[\"t_ms,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps\"]"};
}

}  // namespace

void LinkWatch::open(TimestampNs now_ns) {
  last_bytes_ns_ = last_reading_ns_ = last_inertial_ns_ = now_ns;
}

void LinkWatch::see_bytes(std::size_t count, TimestampNs now_ns) {
  if (count > 0) last_bytes_ns_ = now_ns;
}

void LinkWatch::see_reading(bool inertial, TimestampNs now_ns) {
  last_reading_ns_ = now_ns;
  if (inertial) last_inertial_ns_ = now_ns;
}

std::optional<LinkTrouble> LinkWatch::trouble(std::string_view device, const BoardParser& parser,
                                              TimestampNs now_ns) const {
  if (now_ns - last_inertial_ns_ < kPatienceNs) return std::nullopt;
  const std::string name(device);
  if (now_ns - last_bytes_ns_ >= kPatienceNs) {
    return LinkTrouble{name + " sends nothing",
                       "is this the board's port, and does its program run? press its reset"};
  }
  if (now_ns - last_reading_ns_ >= kPatienceNs) return not_understood(name, parser);
  return LinkTrouble{"no acceleration comes through " + name + ", only other readings",
                     "look at the accelerometer and its wiring; name ax, ay and az in "
                     "imu_gateway.serial.lines"};
}

}  // namespace vpdr::imu_gateway
