#pragma once
// vpdr's own frame for firmware authors: docs/board_protocol.md lays it out byte by byte,
// firmware/vpdr_frame.c is the encoder. COBS between zero bytes; version, contents, sequence
// number, board time in microseconds, little-endian float32 in SI units, CRC-16. Pure.
#include <array>
#include <span>

#include "imu_gateway/core/board_parser.hpp"

namespace vpdr::imu_gateway {

/// CRC-16/CCITT-FALSE: polynomial 0x1021, first value 0xFFFF; of "123456789" it is 0x29B1.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

class FrameParser : public BoardParser {
 public:
  void feed(std::string_view bytes, std::vector<BoardReadings>& out) override;
  void reset() override;

 private:
  void end_frame(std::vector<BoardReadings>& out);
  bool decode_cobs();
  void read_frame(std::vector<BoardReadings>& out);
  bool take_sequence(std::uint16_t sequence, std::uint32_t time_us);

  /// A frame with everything in it has 54 bytes before COBS, 55 after.
  static constexpr std::size_t kLongest = 64;
  std::array<std::uint8_t, kLongest> buffer_{};
  std::size_t size_ = 0;
  bool overlong_ = false;
  std::optional<std::uint16_t> sequence_;  ///< of the last frame
  std::uint32_t time_us_ = 0;
};

}  // namespace vpdr::imu_gateway
