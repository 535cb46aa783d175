#include <gtest/gtest.h>

#include <algorithm>

#include "mcap/encode.hpp"
#include "mcap/reader.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mcap/sample_file.hpp"

namespace vpdr::mcap {
namespace {

using testing::as_bytes;
using testing::open;
using testing::read_all;
using testing::read_bytes;
using testing::Seen;
using testing::write_walk;
using vpdr::testing::TemporaryFolder;

struct Walk {
  Buffer bytes;
  std::vector<Seen> written;
};

Walk make_walk(int seconds, WriterOptions options = {}) {
  const TemporaryFolder folder;
  options.sync = SyncPolicy::kNever;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap", options).value());
  Walk walk;
  static_cast<void>(writer.write(Metadata{"vpdr.walk", {{"walker", "ann"}}}));
  walk.written = write_walk(writer, seconds);
  if (!writer.close()) throw std::runtime_error("cannot write the test file");
  walk.bytes = read_bytes(folder.path() / "a.mcap");
  return walk;
}

TEST(Reader, GivesBackEveryMessageBySummary) {
  const Walk walk = make_walk(3);
  const Reader reader = open(walk.bytes);
  const Contents& contents = reader.contents();
  EXPECT_TRUE(contents.from_summary);
  EXPECT_EQ(contents.incomplete, "");
  EXPECT_EQ(contents.header.profile, "ros2");
  EXPECT_EQ(contents.compression, "zstd");
  EXPECT_EQ(contents.statistics.message_count, 330U);
  EXPECT_EQ(contents.statistics.start_ns, kNsPerSecond);
  EXPECT_EQ(contents.statistics.end_ns, kNsPerSecond + 299 * (kNsPerSecond / 100));
  ASSERT_EQ(contents.metadata.size(), 1U);
  EXPECT_EQ(contents.metadata[0].entries.at("walker"), "ann");
  EXPECT_EQ(reader.schema_of(contents.channels.at(1))->name, "std_msgs/msg/String");
  EXPECT_EQ(read_all(reader), walk.written);
}

TEST(Reader, SelectsTopicsAndTimes) {
  const Walk walk = make_walk(3);
  const Reader reader = open(walk.bytes);
  Selection selection;
  selection.topics = {"rt/ann/fusion/pose"};
  selection.from_ns = 2 * kNsPerSecond;
  selection.until_ns = 2 * kNsPerSecond + kNsPerSecond / 10;
  const std::vector<Seen> seen = read_all(reader, selection);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].data, "pose 100");
  EXPECT_EQ(seen[1].data, "pose 110");
}

TEST(Reader, MergesOverlappingChunksByLogTime) {
  // Log times 0 2 4 ... in the first chunk, 1 3 5 ... in the second.
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  const auto channel = writer.add_channel({0, 0, "t", "cdr", {}}).value();
  for (int i = 0; i < 20; i += 2) ASSERT_TRUE(writer.write(Message{channel, 0, i, 0, {}}));
  ASSERT_TRUE(writer.flush());
  for (int i = 19; i > 0; i -= 2) ASSERT_TRUE(writer.write(Message{channel, 0, i, 0, {}}));
  ASSERT_TRUE(writer.close());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  const std::vector<Seen> by_time = read_all(reader);
  ASSERT_EQ(by_time.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(by_time[static_cast<std::size_t>(i)].log_time_ns, i);
  Selection as_written;
  as_written.order = Order::kFile;
  const std::vector<Seen> by_file = read_all(reader, as_written);
  EXPECT_EQ(by_file[1].log_time_ns, 2);
  EXPECT_EQ(by_file[10].log_time_ns, 19);
}

TEST(Reader, ReadsAFileCutAnywhereUpToItsLastWholeChunk) {
  WriterOptions options;
  options.chunk_bytes = 2000;
  const Walk walk = make_walk(1, options);
  std::size_t most = 0;
  for (std::size_t size = 0; size < walk.bytes.size(); ++size) {
    const Result<Reader> reader = Reader::open(open_bytes(Content(walk.bytes).first(size)));
    if (!reader) {
      EXPECT_LT(size, 40U) << reader.error().message;
      continue;
    }
    EXPECT_NE(reader.value().contents().incomplete, "") << size;
    EXPECT_LE(reader.value().contents().readable_bytes, size);
    EXPECT_TRUE(reader.value().contents().damage.empty());
    const std::vector<Seen> seen = read_all(reader.value());
    EXPECT_EQ(seen.size(), reader.value().contents().statistics.message_count);
    EXPECT_GE(seen.size(), most);
    ASSERT_TRUE(std::equal(seen.begin(), seen.end(), walk.written.begin()));
    most = seen.size();
  }
  EXPECT_EQ(most, walk.written.size()) << "cut in the summary, nothing of the data is lost";
}

TEST(Reader, SaysWhereATornFileStops) {
  const Walk walk = make_walk(2);
  const Segment last = open(walk.bytes).contents().segments.back();
  const Reader reader = open(Content(walk.bytes).first(last.offset + 100));
  EXPECT_EQ(reader.contents().incomplete, "the file ends inside a chunk");
  EXPECT_EQ(reader.contents().readable_bytes, last.offset);
}

TEST(Reader, AZeroedTailAfterLossOfPowerIsNotARecord) {
  Walk walk = make_walk(2);
  const Segment last = open(walk.bytes).contents().segments.back();
  std::fill(walk.bytes.begin() + static_cast<std::ptrdiff_t>(last.offset), walk.bytes.end(),
            std::byte{0});
  const Reader reader = open(walk.bytes);
  EXPECT_EQ(reader.contents().readable_bytes, last.offset);
  EXPECT_EQ(read_all(reader).size(), 110U);
}

TEST(Reader, ADamagedChunkIsLeftOutAndTold) {
  Walk walk = make_walk(3);
  const Segment middle = open(walk.bytes).contents().segments.at(1);
  walk.bytes[middle.offset + middle.length / 2] ^= std::byte{0x10};
  const Reader reader = open(walk.bytes);
  MessageStream stream(reader);
  std::size_t count = 0;
  while (stream.next()) ++count;
  EXPECT_EQ(count, 220U);
  ASSERT_EQ(stream.damage().size(), 1U);
  EXPECT_EQ(stream.damage()[0].offset, middle.offset);
}

TEST(Reader, ADamagedChunkInATornFileIsLeftOutAndTold) {
  Walk walk = make_walk(3);
  const Segment middle = open(walk.bytes).contents().segments.at(1);
  walk.bytes[middle.offset + middle.length / 2] ^= std::byte{0x10};
  const Reader reader = open(Content(walk.bytes).first(walk.bytes.size() - 1));
  EXPECT_FALSE(reader.contents().from_summary);
  ASSERT_EQ(reader.contents().damage.size(), 1U);
  EXPECT_EQ(reader.contents().damage[0].offset, middle.offset);
  EXPECT_EQ(read_all(reader).size(), 220U);
}

TEST(Reader, ADamagedSummaryCostsOnlyTheTimeOfAScan) {
  Walk walk = make_walk(2);
  walk.bytes[walk.bytes.size() - 60] ^= std::byte{0x01};
  const Reader reader = open(walk.bytes);
  EXPECT_FALSE(reader.contents().from_summary);
  EXPECT_NE(reader.contents().incomplete.find("summary"), std::string::npos);
  EXPECT_EQ(read_all(reader), walk.written);
}

TEST(Reader, ReadsMessagesOutsideChunksAndNoSummary) {
  Buffer bytes;
  ByteWriter(bytes).bytes(std::as_bytes(std::span(kMagic)));
  append(bytes, Header{"", "by hand"});
  append(bytes, Schema{1, "a/msg/A", "ros2msg", "int32 x"});
  append(bytes, Channel{1, 1, "loose", "cdr", {}});
  append(bytes, Message{1, 1, 20, 20, as_bytes("late")});
  append(bytes, Message{1, 2, 10, 10, as_bytes("early")});
  append(bytes, DataEnd{0});
  append(bytes, Footer{0, 0, 0});
  ByteWriter(bytes).bytes(std::as_bytes(std::span(kMagic)));
  const Reader reader = open(bytes);
  EXPECT_EQ(reader.contents().incomplete, "");
  EXPECT_EQ(reader.contents().readable_bytes, bytes.size());
  const std::vector<Seen> seen = read_all(reader);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].data, "early");
}

TEST(Reader, MessagesOfAChannelThatIsNotDescribedAreTold) {
  Buffer bytes;
  ByteWriter(bytes).bytes(std::as_bytes(std::span(kMagic)));
  append(bytes, Header{"", "by hand"});
  append(bytes, Message{7, 1, 20, 20, as_bytes("x")});
  const Reader reader = open(bytes);
  EXPECT_EQ(reader.contents().damage.size(), 1U);
  EXPECT_TRUE(read_all(reader).empty());
}

TEST(Reader, AChunkAboveTheLimitIsRefused) {
  const Walk walk = make_walk(1);
  ReaderOptions options;
  options.max_chunk_bytes = 1000;
  const Reader reader = open(walk.bytes, options);
  MessageStream stream(reader);
  EXPECT_FALSE(stream.next());
  ASSERT_EQ(stream.damage().size(), 1U);
  EXPECT_NE(stream.damage()[0].reason.find("limit"), std::string::npos);
}

TEST(Reader, OtherFilesAreNamedAsNoRecording) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "note.txt") << "this is some text and no recording at all";
  const Result<Reader> text = Reader::open(folder.path() / "note.txt");
  ASSERT_FALSE(text);
  EXPECT_NE(text.error().message.find("note.txt: is no MCAP recording"), std::string::npos);
  std::ofstream(folder.path() / "empty.mcap").flush();
  EXPECT_NE(Reader::open(folder.path() / "empty.mcap").error().message.find("is empty"),
            std::string::npos);
  EXPECT_NE(Reader::open(folder.path() / "none.mcap").error().message.find("No such file"),
            std::string::npos);
  EXPECT_NE(Reader::open(folder.path() / "").error().message.find("not a regular file"),
            std::string::npos);
}

}  // namespace
}  // namespace vpdr::mcap
