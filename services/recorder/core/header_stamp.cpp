#include "recorder/core/header_stamp.hpp"

#include <cstdint>

namespace vpdr::recorder {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;

std::uint32_t read_uint32(std::span<const std::byte> bytes, bool little_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t shift = 8 * (little_endian ? i : 3 - i);
    value |= std::to_integer<std::uint32_t>(bytes[i]) << shift;
  }
  return value;
}

}  // namespace

std::optional<TimestampNs> header_stamp(std::span<const std::byte> payload) {
  if (payload.size() < kEncapsulationBytes + 8) return std::nullopt;
  const auto representation = std::to_integer<unsigned>(payload[1]);  // 0 big, 1 little endian
  if (payload[0] != std::byte{0} || representation > 1) return std::nullopt;
  const std::span<const std::byte> stamp = payload.subspan(kEncapsulationBytes);
  const auto seconds = static_cast<std::int32_t>(read_uint32(stamp, representation == 1));
  const std::uint32_t nanoseconds = read_uint32(stamp.subspan(4), representation == 1);
  return seconds * kNsPerSecond + nanoseconds;
}

}  // namespace vpdr::recorder
