#pragma once
// Boards that speak each protocol, for tests: one measurement becomes the bytes that a real board
// would send. Written from the protocols' descriptions, not from the parsers.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "firmware/vpdr_frame.h"

namespace vpdr::testing_support {

/// In the units that boards use.
struct Measurement {
  std::uint64_t time_us = 0;
  std::array<double, 3> acceleration_g{0.0, 0.0, 1.0};
  std::array<double, 3> rate_dps{};
  bool has_field = true;
  std::array<double, 3> field_ut{};
};

inline std::string wit_frame(std::uint8_t type, const std::array<std::int16_t, 4>& values) {
  std::string frame{'\x55', static_cast<char>(type)};
  for (const std::int16_t value : values) {
    frame += static_cast<char>(value & 0xFF);
    frame += static_cast<char>((value >> 8) & 0xFF);
  }
  unsigned sum = 0;
  for (const char c : frame) sum += static_cast<unsigned char>(c);
  return frame + static_cast<char>(sum & 0xFFU);
}

inline std::array<std::int16_t, 4> wit_counts(const std::array<double, 3>& values, double unit,
                                              std::int16_t last) {
  const auto count = [unit](double v) { return static_cast<std::int16_t>(std::lround(v / unit)); };
  return {count(values[0]), count(values[1]), count(values[2]), last};
}

/// Acceleration, rate, angle and field, as a WT901 sends them.
inline std::string wit_bytes(const Measurement& m) {
  std::string bytes = wit_frame(0x51, wit_counts(m.acceleration_g, 16.0 / 32768.0, 2500)) +
                      wit_frame(0x52, wit_counts(m.rate_dps, 2000.0 / 32768.0, 2500)) +
                      wit_frame(0x53, {100, 200, 300, 17000});
  if (m.has_field) bytes += wit_frame(0x54, wit_counts(m.field_ut, 0.1, 2500));
  return bytes;
}

inline std::string xio_bytes(const Measurement& m) {
  std::array<char, 160> text{};
  const auto time = static_cast<unsigned long long>(m.time_us);
  std::snprintf(text.data(), text.size(), "I,%llu,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\r\n", time,
                m.rate_dps[0], m.rate_dps[1], m.rate_dps[2], m.acceleration_g[0],
                m.acceleration_g[1], m.acceleration_g[2]);
  std::string bytes = text.data();
  if (!m.has_field) return bytes;
  std::snprintf(text.data(), text.size(), "M,%llu,%.5f,%.5f,%.5f\r\n", time, m.field_ut[0] / 50.0,
                m.field_ut[1] / 50.0, m.field_ut[2] / 50.0);
  return bytes + text.data();
}

/// Of a measurement without a field.
inline constexpr const char* kTextInertialColumns = "t_us,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps";
inline constexpr const char* kTextColumns =
    "t_us,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,mx_uT,my_uT,mz_uT";

inline std::string text_line(const Measurement& m) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%llu,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f",
                static_cast<unsigned long long>(m.time_us), m.acceleration_g[0],
                m.acceleration_g[1], m.acceleration_g[2], m.rate_dps[0], m.rate_dps[1],
                m.rate_dps[2]);
  std::string line = text.data();
  if (!m.has_field) return line;
  std::snprintf(text.data(), text.size(), ",%.3f,%.3f,%.3f", m.field_ut[0], m.field_ut[1],
                m.field_ut[2]);
  return line + text.data();
}

inline std::string text_bytes(const Measurement& m) { return text_line(m) + "\n"; }

/// The same line with its checksum.
inline std::string checked_text_bytes(const Measurement& m) {
  const std::string line = text_line(m);
  unsigned sum = 0;
  for (const char c : line) sum ^= static_cast<unsigned char>(c);
  std::array<char, 8> end{};
  std::snprintf(end.data(), end.size(), "*%02X\r\n", sum & 0xFFU);
  return "$" + line + end.data();
}

/// By the reference encoder.
inline std::string vpdr_bytes(const Measurement& m, std::uint16_t sequence) {
  vpdr_frame frame{};
  frame.contents = VPDR_ACCELERATION | VPDR_ANGULAR_RATE;
  if (m.has_field) frame.contents |= VPDR_MAGNETIC_FIELD;
  frame.sequence = sequence;
  frame.time_us = static_cast<std::uint32_t>(m.time_us);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    frame.acceleration_mps2[i] = static_cast<float>(m.acceleration_g[axis] * 9.80665);
    frame.angular_rate_radps[i] = static_cast<float>(m.rate_dps[axis] * M_PI / 180.0);
    frame.magnetic_field_ut[i] = static_cast<float>(m.field_ut[axis]);
  }
  std::array<std::uint8_t, VPDR_FRAME_MAX_BYTES> bytes{};
  const std::size_t size = vpdr_frame_encode(&frame, bytes.data());
  return {reinterpret_cast<const char*>(bytes.data()), size};
}

}  // namespace vpdr::testing_support
