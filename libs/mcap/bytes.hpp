#pragma once
// Little-endian bytes in and out. Reading is bounds-checked: the first read past the end makes
// ok() false for good and every read from then on gives zero or nothing, so that a parser reads
// all its fields and asks once.
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "mcap/records.hpp"

namespace vpdr::mcap {

using Buffer = std::vector<std::byte>;

/// Appends to a buffer. Not thread-safe.
class ByteWriter {
 public:
  explicit ByteWriter(Buffer& out) : out_(out) {}

  template <std::unsigned_integral T>
  void integer(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      out_.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
  }
  void time(TimestampNs ns) { integer(static_cast<std::uint64_t>(ns)); }
  void bytes(std::span<const std::byte> data);
  /// Length as uint32, then the characters.
  void string(std::string_view text);
  /// Length in bytes as uint32, then the pairs.
  void map(const StringMap& map);

 private:
  Buffer& out_;
};

/// Reads from a span. Views it gives live as long as the span. Not thread-safe.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> in) : in_(in) {}

  template <std::unsigned_integral T>
  T integer() {
    const std::span<const std::byte> raw = bytes(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(raw[i]) << (8 * i)));
    }
    return value;
  }
  /// A time beyond int64 is a failed read.
  TimestampNs time();
  std::span<const std::byte> bytes(std::uint64_t count);
  std::string_view string();
  StringMap map();

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t remaining() const { return in_.size(); }

 private:
  std::span<const std::byte> in_;
  bool ok_ = true;
};

}  // namespace vpdr::mcap
