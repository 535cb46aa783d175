#include "mcap/bytes.hpp"

#include <limits>

namespace vpdr::mcap {

void ByteWriter::bytes(std::span<const std::byte> data) {
  out_.insert(out_.end(), data.begin(), data.end());
}

void ByteWriter::string(std::string_view text) {
  integer(static_cast<std::uint32_t>(text.size()));
  bytes(std::as_bytes(std::span(text.data(), text.size())));
}

void ByteWriter::map(const StringMap& map) {
  std::size_t size = 0;
  for (const auto& [key, value] : map) size += 8 + key.size() + value.size();
  integer(static_cast<std::uint32_t>(size));
  for (const auto& [key, value] : map) {
    string(key);
    string(value);
  }
}

TimestampNs ByteReader::time() {
  const auto raw = integer<std::uint64_t>();
  if (raw > static_cast<std::uint64_t>(std::numeric_limits<TimestampNs>::max())) {
    ok_ = false;
    return 0;
  }
  return static_cast<TimestampNs>(raw);
}

std::span<const std::byte> ByteReader::bytes(std::uint64_t count) {
  if (!ok_ || count > in_.size()) {
    ok_ = false;
    in_ = {};
    return {};
  }
  const std::span<const std::byte> taken = in_.first(static_cast<std::size_t>(count));
  in_ = in_.subspan(static_cast<std::size_t>(count));
  return taken;
}

std::string_view ByteReader::string() {
  const std::span<const std::byte> raw = bytes(integer<std::uint32_t>());
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

StringMap ByteReader::map() {
  StringMap result;
  ByteReader pairs(bytes(integer<std::uint32_t>()));
  while (pairs.ok() && pairs.remaining() > 0) {
    const std::string_view key = pairs.string();
    const std::string_view value = pairs.string();
    if (pairs.ok()) result.insert_or_assign(std::string(key), std::string(value));
  }
  ok_ = ok_ && pairs.ok();
  return result;
}

}  // namespace vpdr::mcap
