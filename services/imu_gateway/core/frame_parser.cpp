#include "imu_gateway/core/frame_parser.hpp"

#include <bit>

namespace vpdr::imu_gateway {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kHead = 8;
constexpr std::size_t kCrc = 2;
enum Content : std::uint8_t {
  kForce = 1,
  kRate = 2,
  kField = 4,
  kPressure = 8,
  kTemperature = 16,
};
constexpr std::uint8_t kKnownContents = kForce | kRate | kField | kPressure | kTemperature;
/// A number further back than this is no frame out of order: the board has started again.
constexpr std::uint16_t kFarthestBack = 16;

std::uint16_t u16(const std::uint8_t* p) { return static_cast<std::uint16_t>(p[0] | (p[1] << 8)); }

std::uint32_t u32(const std::uint8_t* p) {
  return u16(p) | (static_cast<std::uint32_t>(u16(p + 2)) << 16);
}

double f32(const std::uint8_t*& p) {
  const double value = std::bit_cast<float>(u32(p));
  p += 4;
  return value;
}

Eigen::Vector3d vector(const std::uint8_t*& p) {
  const double x = f32(p);
  const double y = f32(p);
  const double z = f32(p);
  return {x, y, z};
}

std::size_t size_of(std::uint8_t contents) {
  const std::size_t vectors = std::popcount(static_cast<unsigned>(contents & 0x07U));
  const std::size_t scalars = std::popcount(static_cast<unsigned>(contents & 0x18U));
  return kHead + 12 * vectors + 4 * scalars + kCrc;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x1021U : crc << 1;
  }
  return static_cast<std::uint16_t>(crc);
}

void FrameParser::reset() {
  size_ = 0;
  overlong_ = false;
  sequence_.reset();
}

void FrameParser::feed(std::string_view bytes, std::vector<BoardReadings>& out) {
  for (const char c : bytes) {
    if (c == '\0') {
      end_frame(out);
    } else if (size_ == buffer_.size()) {
      overlong_ = true;
    } else {
      buffer_[size_++] = static_cast<std::uint8_t>(c);
    }
  }
}

void FrameParser::end_frame(std::vector<BoardReadings>& out) {
  if (overlong_) {
    ++counts_.overlong;
  } else if (size_ > 0) {
    if (decode_cobs()) {
      read_frame(out);
    } else {
      ++counts_.malformed;
    }
  }
  size_ = 0;
  overlong_ = false;
}

/// In place: each code byte says how far it is to the next one, with a zero between them.
bool FrameParser::decode_cobs() {
  std::size_t written = 0;
  for (std::size_t at = 0; at < size_;) {
    const std::size_t code = buffer_[at];
    if (at + code > size_) return false;
    for (std::size_t i = 1; i < code; ++i) buffer_[written++] = buffer_[at + i];
    at += code;
    if (at < size_ && code < 0xFF) buffer_[written++] = 0;
  }
  size_ = written;
  return size_ >= kHead + kCrc &&
         crc16({buffer_.data(), size_ - kCrc}) == u16(buffer_.data() + size_ - kCrc);
}

void FrameParser::read_frame(std::vector<BoardReadings>& out) {
  const std::uint8_t contents = buffer_[1];
  if (buffer_[0] != kVersion || (contents & ~kKnownContents) != 0) {
    ++counts_.unknown_layout;
    return;
  }
  if (size_of(contents) != size_) {
    ++counts_.malformed;
    return;
  }
  const std::uint32_t time_us = u32(buffer_.data() + 4);
  if (!take_sequence(u16(buffer_.data() + 2), time_us)) return;
  BoardReadings readings;
  readings.board_stamp_ns = TimestampNs{time_us} * 1000;
  readings.clock_wraps_at_ns = (TimestampNs{1} << 32) * 1000;
  const std::uint8_t* p = buffer_.data() + kHead;
  if ((contents & kForce) != 0) readings.specific_force_mps2 = vector(p);
  if ((contents & kRate) != 0) readings.angular_velocity_radps = vector(p);
  if ((contents & kField) != 0) readings.field_ut = vector(p);
  if ((contents & kPressure) != 0) readings.pressure_pa = f32(p);
  if ((contents & kTemperature) != 0) readings.temperature_c = f32(p);
  out.push_back(readings);
}

bool FrameParser::take_sequence(std::uint16_t sequence, std::uint32_t time_us) {
  const bool first = !sequence_;
  const auto ahead = static_cast<std::uint16_t>(sequence - sequence_.value_or(0));
  if (!first && ahead == 0 && time_us == time_us_) {
    ++counts_.duplicates;
    return false;
  }
  const bool out_of_order = !first && static_cast<std::uint16_t>(-ahead) <= kFarthestBack;
  if (out_of_order) {
    if (counts_.lost > 0) --counts_.lost;  // it was counted as missing
    return true;
  }
  const bool forward = ahead > 0 && ahead < 0x8000;
  if (!first && forward) counts_.lost += ahead - 1U;
  sequence_ = sequence;
  time_us_ = time_us;
  return true;
}

}  // namespace vpdr::imu_gateway
