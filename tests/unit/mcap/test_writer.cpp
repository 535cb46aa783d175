#include <gtest/gtest.h>

#include "mcap/reader.hpp"
#include "mcap/writer.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/mcap/sample_file.hpp"

namespace vpdr::mcap {
namespace {

using testing::as_bytes;
using testing::read_all;
using testing::read_bytes;
using testing::Seen;
using testing::write_walk;
using vpdr::testing::FileSizeLimit;
using vpdr::testing::TemporaryFolder;

TEST(Writer, BeginsAndEndsWithTheMagic) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Writer::create(folder.path() / "a.mcap").value().close());
  const Buffer bytes = read_bytes(folder.path() / "a.mcap");
  ASSERT_GT(bytes.size(), 16U);
  const auto magic = std::as_bytes(std::span(kMagic));
  EXPECT_TRUE(std::equal(magic.begin(), magic.end(), bytes.begin()));
  EXPECT_TRUE(std::equal(magic.begin(), magic.end(), bytes.end() - 8));
}

TEST(Writer, RefusesToOverwriteAndLeavesTheOldFileAlone) {
  const TemporaryFolder folder;
  ASSERT_TRUE(Writer::create(folder.path() / "a.mcap").value().close());
  const Buffer before = read_bytes(folder.path() / "a.mcap");
  const Result<Writer> second = Writer::create(folder.path() / "a.mcap");
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("a.mcap"), std::string::npos);
  EXPECT_NE(second.error().message.find("never overwritten"), std::string::npos);
  EXPECT_EQ(read_bytes(folder.path() / "a.mcap"), before);
}

TEST(Writer, NamesAFolderThatIsMissing) {
  const TemporaryFolder folder;
  const Result<Writer> writer = Writer::create(folder.path() / "none/a.mcap");
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().message.find("create the folder first"), std::string::npos);
}

TEST(Writer, GivesTheSameSchemaTheSameId) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  const auto first = writer.add_schema("a/msg/A", "ros2msg", "int32 x");
  EXPECT_EQ(first.value(), 1);
  EXPECT_EQ(writer.add_schema("a/msg/A", "ros2msg", "int32 x").value(), 1);
  EXPECT_EQ(writer.add_schema("a/msg/A", "ros2msg", "int64 x").value(), 2);
}

TEST(Writer, RefusesUnknownIdsAndNegativeTimes) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  EXPECT_FALSE(writer.add_channel({0, 9, "t", "cdr", {}}));
  EXPECT_FALSE(writer.write(Message{1, 1, 1, 1, {}}));
  const auto channel = writer.add_channel({0, 0, "t", "cdr", {}});
  EXPECT_FALSE(writer.write(Message{channel.value(), 1, -1, 1, {}}));
  EXPECT_TRUE(writer.write(Message{channel.value(), 1, 1, 1, {}}));
  EXPECT_TRUE(writer.close());
  EXPECT_EQ(writer.statistics().message_count, 1U);
}

TEST(Writer, AChunkSpansAtMostASecondOfLogTime) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  write_walk(writer, 5);
  ASSERT_TRUE(writer.close());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  EXPECT_EQ(reader.contents().segments.size(), 5U);
  for (const Segment& segment : reader.contents().segments) {
    EXPECT_LT(segment.end_ns - segment.start_ns, kNsPerSecond);
  }
}

TEST(Writer, AFullChunkIsWrittenBeforeItGrowsBeyondItsSize) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.chunk_bytes = 1000;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap", options).value());
  write_walk(writer, 2);
  ASSERT_TRUE(writer.close());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  EXPECT_GT(reader.contents().segments.size(), 8U);
  for (const Segment& segment : reader.contents().segments) {
    EXPECT_LE(segment.uncompressed_size, 1000U);
  }
}

TEST(Writer, MessagesCountWhenTheirChunkIsInTheFile) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  const auto channel = writer.add_channel({0, 0, "t", "cdr", {}}).value();
  ASSERT_TRUE(writer.write(Message{channel, 1, 1, 1, {}}));
  EXPECT_EQ(writer.messages_in_file(channel), 0U);
  ASSERT_TRUE(writer.flush());
  EXPECT_EQ(writer.messages_in_file(channel), 1U);
  EXPECT_EQ(writer.bytes_in_file(), std::filesystem::file_size(folder.path() / "a.mcap"));
}

TEST(Writer, WhatIsFlushedIsReadableBeforeTheFileIsClosed) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  const std::vector<Seen> written = write_walk(writer, 1);
  ASSERT_TRUE(writer.flush());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  EXPECT_FALSE(reader.contents().incomplete.empty());
  EXPECT_EQ(read_all(reader), written);
}

TEST(Writer, UncompressedChunksReadTheSame) {
  const TemporaryFolder folder;
  WriterOptions options;
  options.compression = Compression::kNone;
  options.sync = SyncPolicy::kNever;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap", options).value());
  const std::vector<Seen> written = write_walk(writer, 2);
  ASSERT_TRUE(writer.close());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  EXPECT_EQ(reader.contents().compression, "none");
  EXPECT_EQ(read_all(reader), written);
}

TEST(Writer, ClosingTwiceGivesTheFirstResultAndAChannelWithoutMessagesIsKept) {
  const TemporaryFolder folder;
  Writer writer = std::move(Writer::create(folder.path() / "a.mcap").value());
  ASSERT_TRUE(writer.add_channel({0, 0, "silent", "cdr", {}}));
  ASSERT_TRUE(writer.close());
  ASSERT_TRUE(writer.close());
  const Reader reader = std::move(Reader::open(folder.path() / "a.mcap").value());
  EXPECT_EQ(reader.contents().channels.at(1).topic, "silent");
  EXPECT_TRUE(reader.contents().incomplete.empty());
}

TEST(Writer, AFullDiskKeepsEveryWholeChunk) {
  // At every limit: either the file could not be made, or it holds a whole number of chunks.
  std::size_t most = 0;
  for (rlim_t limit = 0; limit < 9000; limit += 97) {
    const TemporaryFolder folder;
    std::vector<Seen> written;
    std::uint64_t in_file = 0;
    {
      const FileSizeLimit full(limit);
      WriterOptions options;
      options.compression = Compression::kNone;
      options.chunk_bytes = 1200;
      options.sync = SyncPolicy::kNever;
      Result<Writer> writer = Writer::create(folder.path() / "a.mcap", options);
      if (!writer) {
        EXPECT_LT(limit, 100U) << writer.error().message;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.mcap"));
        continue;
      }
      written = write_walk(writer.value(), 3);
      const Status closed = writer.value().close();
      ASSERT_FALSE(closed);
      EXPECT_NE(closed.error().message.find("a.mcap"), std::string::npos);
      EXPECT_NE(closed.error().message.find("free some space"), std::string::npos);
      in_file = writer.value().statistics().message_count;
    }
    const Result<Reader> reader = Reader::open(folder.path() / "a.mcap");
    ASSERT_TRUE(reader) << reader.error().message;
    const std::vector<Seen> kept = read_all(reader.value());
    EXPECT_EQ(kept.size(), in_file) << limit;
    EXPECT_TRUE(reader.value().contents().damage.empty());
    ASSERT_LE(kept.size(), written.size());
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), written.begin())) << limit;
    EXPECT_GE(kept.size(), most) << "more room, fewer messages";
    most = kept.size();
  }
  EXPECT_GT(most, 50U);
}

}  // namespace
}  // namespace vpdr::mcap
