// libFuzzer target, one for each protocol (VPDR_FUZZ_PROTOCOL): any bytes in pieces of any size as
// what a board sends, through parser and clocks. No crash, no hang, and after whatever it was the
// parser finds the beat again: the third good frame comes through.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "imu_gateway/core/board_stream.hpp"
#include "imu_gateway/core/make_parser.hpp"
#include "tests/support/boards.hpp"

namespace {

using namespace vpdr::imu_gateway;      // NOLINT: a program, not a header
using namespace vpdr::testing_support;  // NOLINT

constexpr Protocol kProtocol = Protocol::VPDR_FUZZ_PROTOCOL;

std::string good_frame(int i) {
  Measurement m;
  m.time_us = 3'000'000'000 + static_cast<std::uint64_t>(i) * 1000;
  m.rate_dps = {1.0 * i, -2.0, 3.0};
  switch (kProtocol) {
    case Protocol::kText:
      return checked_text_bytes(m);
    case Protocol::kXio:
      return xio_bytes(m);
    case Protocol::kWit:  // with its time, which a board that once sent times is asked for
      return wit_frame(0x50, {24 | (2 << 8), 28 | (12 << 8), 34 | (56 << 8),
                              static_cast<std::int16_t>(100 + i)}) +
             wit_bytes(m);
    case Protocol::kVpdr:
      return vpdr_bytes(m, static_cast<std::uint16_t>(40'000 + i));
  }
  return {};
}

/// The first bytes say how large the pieces are and how fast they come.
void feed_all(std::string_view bytes, BoardParser& parser, BoardStream& stream) {
  std::vector<BoardReadings> parsed;
  std::vector<vpdr::Reading> samples;
  vpdr::TimestampNs arrival_ns = 1'700'000'000 * vpdr::kNsPerSecond;
  while (!bytes.empty()) {
    const std::size_t piece = 1 + static_cast<std::uint8_t>(bytes.front()) % 50;
    parsed.clear();
    parser.feed(bytes.substr(0, piece), parsed);
    // More readings than bytes would be made of nothing.
    if (parsed.size() > piece + 64) std::abort();
    samples.clear();
    for (const BoardReadings& readings : parsed) stream.accept(readings, arrival_ns, samples);
    arrival_ns += static_cast<std::int64_t>(piece) * 1'000'000;
    bytes.remove_prefix(std::min(piece, bytes.size()));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ParserOptions options;
  options.protocol = kProtocol;
  options.lines.layouts = {LineLayout::parse(kTextColumns).value()};
  const auto parser = make_parser(options);
  BoardStream stream({});
  feed_all({reinterpret_cast<const char*>(data), size}, *parser, stream);

  std::vector<BoardReadings> out;
  for (int i = 0; i < 3; ++i) {
    out.clear();
    parser->feed(good_frame(i), out);
  }
  if (out.empty()) std::abort();
  return 0;
}
