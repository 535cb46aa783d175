#pragma once
// CRC-32 of ISO 3309 and zip (polynomial 0x04C11DB7 reflected, initial value and final xor all
// ones), eight bytes at a time: the check value of every MCAP record that has one.
#include <cstddef>
#include <cstdint>
#include <span>

namespace vpdr::mcap {

/// A CRC over bytes that arrive in pieces. Not thread-safe.
class Crc32 {
 public:
  void update(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

/// CRC of one piece.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes);

}  // namespace vpdr::mcap
