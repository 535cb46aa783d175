// Thousands of damaged files, the same ones on every run: the reader may give fewer messages or
// none, but it stays within its bounds (run under the sanitizers) and comes to an end.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mcap/sample_file.hpp"

namespace vpdr::mcap {
namespace {

using testing::read_bytes;
using testing::write_walk;
using vpdr::testing::TemporaryFolder;

constexpr std::uint64_t kMessages = 220;

Buffer make_file(Compression compression) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.chunk_bytes = 3000;
  options.compression = compression;
  options.sync = SyncPolicy::kNever;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap", options).value());
  write_walk(writer, 2);
  static_cast<void>(writer.write(Metadata{"vpdr", {{"walker", "ann"}}}));
  static_cast<void>(writer.close());
  return read_bytes(folder.path() / "a.mcap");
}

void mutate(Buffer& bytes, std::mt19937& random) {
  const auto at = [&] { return random() % bytes.size(); };
  switch (random() % 5) {
    case 0:
      bytes[at()] ^= static_cast<std::byte>(1U << (random() % 8));
      break;
    case 1:
      bytes[at()] = static_cast<std::byte>(random());
      break;
    case 2:
      bytes[at()] = std::byte{0xFF};
      break;
    case 3:
      bytes.resize(1 + at());
      break;
    default: {  // a piece from elsewhere in the file
      const std::size_t from = at();
      const std::size_t to = at();
      const std::size_t count = std::min({random() % 64, bytes.size() - from, bytes.size() - to});
      std::copy_n(Buffer(bytes).begin() + static_cast<std::ptrdiff_t>(from), count,
                  bytes.begin() + static_cast<std::ptrdiff_t>(to));
      break;
    }
  }
}

/// Messages that can still be read; 0 for a file that is refused.
std::uint64_t read_whole(const Buffer& bytes) {
  ReaderOptions options;
  options.max_chunk_bytes = 1U << 20U;
  options.max_loaded_bytes = 4U << 20U;
  const Result<Reader> reader = Reader::open(open_bytes(bytes), options);
  if (!reader) return 0;
  MessageStream stream(reader.value());
  std::uint64_t count = 0;
  std::uint64_t sum = 0;
  while (const std::optional<Message> message = stream.next()) {
    ++count;
    for (const std::byte byte : message->data) sum += std::to_integer<std::uint64_t>(byte);
  }
  EXPECT_LT(sum, bytes.size() * 255 * 1000);
  return count;
}

class Mutations : public ::testing::TestWithParam<Compression> {};

TEST_P(Mutations, NeverLeaveTheBounds) {
  const Buffer whole = make_file(GetParam());
  ASSERT_EQ(read_whole(whole), kMessages);
  std::mt19937 random(20240607);
  std::uint64_t intact = 0;
  std::uint64_t refused = 0;
  for (int run = 0; run < 1500; ++run) {
    Buffer bytes = whole;
    const unsigned changes = 1 + random() % 4;
    for (unsigned i = 0; i < changes; ++i) mutate(bytes, random);
    const std::uint64_t count = read_whole(bytes);
    intact += count == kMessages ? 1 : 0;
    refused += count == 0 ? 1 : 0;
  }
  // The changes did reach the data, and did not always destroy all of it.
  EXPECT_LT(intact, 1200U);
  EXPECT_LT(refused, 1200U);
}

INSTANTIATE_TEST_SUITE_P(Files, Mutations,
                         ::testing::Values(Compression::kNone, Compression::kZstd));

}  // namespace
}  // namespace vpdr::mcap
