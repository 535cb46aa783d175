#include <gtest/gtest.h>

#include "imu_gateway/core/frame_parser.hpp"
#include "tests/support/boards.hpp"

namespace vpdr::imu_gateway {
namespace {

using testing_support::vpdr_bytes;

std::vector<BoardReadings> parse(FrameParser& parser, std::string_view bytes) {
  std::vector<BoardReadings> out;
  parser.feed(bytes, out);
  return out;
}

std::string encoded(const vpdr_frame& frame) {
  std::array<std::uint8_t, VPDR_FRAME_MAX_BYTES> bytes{};
  const std::size_t size = vpdr_frame_encode(&frame, bytes.data());
  return {reinterpret_cast<const char*>(bytes.data()), size};
}

TEST(Crc16, KnowsTheCheckValue) {
  const std::string text = "123456789";
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  EXPECT_EQ(crc16({bytes, text.size()}), 0x29B1);
  EXPECT_EQ(vpdr_crc16(bytes, text.size()), 0x29B1);
}

TEST(FrameParser, ReadsTheFrameOfTheDocumentation) {
  // docs/board_protocol.md: pressure alone, sequence 2, 1000 us, 101325 Pa = 0x47C5E680.
  const std::string bytes("\x04\x01\x08\x02\x03\xE8\x03\x01\x07\x80\xE6\xC5\x47\xC2\x53\x00", 16);
  FrameParser parser;
  const auto out = parse(parser, bytes);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].board_stamp_ns, 1'000'000);
  EXPECT_EQ(out[0].pressure_pa, 101325.0);
  vpdr_frame frame{};
  frame.contents = VPDR_PRESSURE;
  frame.sequence = 2;
  frame.time_us = 1000;
  frame.pressure_pa = 101325.0F;
  EXPECT_EQ(encoded(frame), bytes);
}

TEST(FrameParser, ReadsEveryCombinationOfContents) {
  for (unsigned contents = 0; contents < 32; ++contents) {
    vpdr_frame frame{};
    frame.contents = static_cast<std::uint8_t>(contents);
    frame.sequence = 0x0100;  // zeros in every place, for COBS
    frame.time_us = 4'000'000'000U;
    for (int i = 0; i < 3; ++i) {
      frame.acceleration_mps2[i] = static_cast<float>(i);
      frame.angular_rate_radps[i] = static_cast<float>(-0.5 * i);
      frame.magnetic_field_ut[i] = static_cast<float>(10.0 + i);
    }
    frame.pressure_pa = 100'000.0F;
    frame.temperature_c = -12.5F;
    FrameParser parser;
    const auto out = parse(parser, encoded(frame));
    ASSERT_EQ(out.size(), 1U) << contents;
    EXPECT_EQ(out[0].board_stamp_ns, 4'000'000'000'000);
    EXPECT_EQ(out[0].specific_force_mps2.has_value(), (contents & VPDR_ACCELERATION) != 0);
    EXPECT_EQ(out[0].angular_velocity_radps.has_value(), (contents & VPDR_ANGULAR_RATE) != 0);
    EXPECT_EQ(out[0].field_ut.has_value(), (contents & VPDR_MAGNETIC_FIELD) != 0);
    EXPECT_EQ(out[0].pressure_pa.has_value(), (contents & VPDR_PRESSURE) != 0);
    EXPECT_EQ(out[0].temperature_c.has_value(), (contents & VPDR_TEMPERATURE) != 0);
    if (out[0].specific_force_mps2) {
      EXPECT_EQ(*out[0].specific_force_mps2, Eigen::Vector3d(0, 1, 2));
    }
    if (out[0].angular_velocity_radps) {
      EXPECT_EQ(*out[0].angular_velocity_radps, Eigen::Vector3d(0, -0.5, -1));
    }
    EXPECT_EQ(out[0].field_ut.value_or(Eigen::Vector3d(10, 11, 12)), Eigen::Vector3d(10, 11, 12));
    EXPECT_EQ(out[0].pressure_pa.value_or(100'000.0), 100'000.0);
    EXPECT_EQ(out[0].temperature_c.value_or(-12.5), -12.5);
  }
}

TEST(FrameParser, CountsWhatTheSequenceNumbersTell) {
  FrameParser parser;
  const auto frame = [](int sequence) {
    return vpdr_bytes({.time_us = static_cast<std::uint64_t>(sequence) * 1000},
                      static_cast<std::uint16_t>(sequence));
  };
  EXPECT_EQ(parse(parser, frame(65534) + frame(65535) + frame(65536)).size(), 3U);
  EXPECT_EQ(parser.counts().lost, 0U);
  EXPECT_EQ(parse(parser, frame(65540)).size(), 1U);  // 65537, 65538 and 65539 did not come
  EXPECT_EQ(parser.counts().lost, 3U);
  EXPECT_EQ(parse(parser, frame(65538)).size(), 1U);  // late: the clock's order is the gate's task
  EXPECT_EQ(parser.counts().lost, 2U);
  EXPECT_TRUE(parse(parser, frame(65540)).empty());
  EXPECT_EQ(parser.counts().duplicates, 1U);
}

TEST(FrameParser, RefusesWhatItDoesNotKnow) {
  std::vector<std::uint8_t> raw{2, 0, 0, 1, 1, 1, 1, 1};  // version 2
  const std::uint16_t crc = crc16(raw);
  raw.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  raw.push_back(static_cast<std::uint8_t>(crc >> 8U));
  std::string bytes = "\x02\x02\x01";  // COBS of 2, 0, 0
  bytes += '\x08';
  for (std::size_t i = 3; i < raw.size(); ++i) bytes += static_cast<char>(raw[i]);
  bytes += '\0';
  FrameParser parser;
  EXPECT_TRUE(parse(parser, bytes).empty());
  EXPECT_EQ(parser.counts().unknown_layout, 1U);
}

TEST(FrameParser, FindsTheBeatWithTheNextFrame) {
  FrameParser parser;
  const std::string noise =
      "ets Jan  8 2013,rst cause:2, boot mode:(3,6)\r\nload 0x40100000, "
      "len 1384, room 16 tail 8 chksum 0x2d";
  EXPECT_EQ(parse(parser, noise + vpdr_bytes({}, 0) + vpdr_bytes({}, 1)).size(), 1U);
  EXPECT_EQ(parser.counts().overlong, 1U);
}

}  // namespace
}  // namespace vpdr::imu_gateway
