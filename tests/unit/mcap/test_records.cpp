// Bytes, CRC and single records against values worked by hand from the format's description.
#include <gtest/gtest.h>

#include <string>

#include "mcap/bytes.hpp"
#include "mcap/crc32.hpp"
#include "mcap/encode.hpp"
#include "mcap/parse.hpp"
#include "tests/unit/mcap/sample_file.hpp"

namespace vpdr::mcap {
namespace {

using testing::as_bytes;

Buffer from_ints(std::initializer_list<int> values) {
  Buffer out;
  for (const int value : values) out.push_back(static_cast<std::byte>(value));
  return out;
}

TEST(Crc32, CheckValueOfTheStandard) {
  EXPECT_EQ(crc32(as_bytes("123456789")), 0xCBF43926U);
  EXPECT_EQ(crc32({}), 0U);
}

TEST(Crc32, PiecesGiveTheSameAsTheWhole) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += static_cast<char>(i * 37);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Crc32 crc;
    crc.update(as_bytes(text).first(cut));
    crc.update(as_bytes(text).subspan(cut));
    EXPECT_EQ(crc.value(), crc32(as_bytes(text))) << cut;
  }
}

TEST(ByteReader, IntegersAreLittleEndian) {
  const Buffer bytes = from_ints({0x01, 0x02, 0x34, 0x12, 0x78, 0x56, 0x34, 0x12});
  ByteReader r(bytes);
  EXPECT_EQ(r.integer<std::uint8_t>(), 0x01);
  EXPECT_EQ(r.integer<std::uint8_t>(), 0x02);
  EXPECT_EQ(r.integer<std::uint16_t>(), 0x1234);
  EXPECT_EQ(r.integer<std::uint32_t>(), 0x12345678U);
  EXPECT_TRUE(r.ok());
  EXPECT_EQ(r.remaining(), 0U);
}

TEST(ByteReader, AnOverrunFailsForGood) {
  const Buffer bytes = from_ints({1, 2, 3});
  ByteReader r(bytes);
  EXPECT_EQ(r.integer<std::uint32_t>(), 0U);
  EXPECT_FALSE(r.ok());
  EXPECT_EQ(r.integer<std::uint8_t>(), 0U) << "also what would have fitted";
  EXPECT_FALSE(r.ok());
}

TEST(ByteReader, AStringLongerThanTheRestFails) {
  const Buffer bytes = from_ints({0xFF, 0xFF, 0xFF, 0xFF, 'a'});
  ByteReader r(bytes);
  EXPECT_EQ(r.string(), "");
  EXPECT_FALSE(r.ok());
}

TEST(ByteReader, AMapThatEndsInsideAPairFails) {
  // 6 bytes of pairs: key "a" and then only one byte of the value's length.
  const Buffer bytes = from_ints({6, 0, 0, 0, 1, 0, 0, 0, 'a', 1, 9, 9});
  ByteReader r(bytes);
  static_cast<void>(r.map());
  EXPECT_FALSE(r.ok());
}

TEST(ByteReader, ATimeBeyondInt64Fails) {
  const Buffer bytes = from_ints({0, 0, 0, 0, 0, 0, 0, 0x80});
  ByteReader r(bytes);
  static_cast<void>(r.time());
  EXPECT_FALSE(r.ok());
}

TEST(Encode, HeaderByHand) {
  Buffer out;
  append(out, Header{"ros2", "v"});
  EXPECT_EQ(out, from_ints({0x01, 13, 0, 0, 0,   0,   0,   0,   0,  //
                            4,    0,  0, 0, 'r', 'o', 's', '2',     //
                            1,    0,  0, 0, 'v'}));
}

TEST(Encode, MessageByHand) {
  const Buffer data = from_ints({0xAB, 0xCD});
  Buffer out;
  append(out, Message{0x0102, 7, 0x1122334455667788, 1, data});
  EXPECT_EQ(out, from_ints({0x05, 24,   0,    0,    0,    0,    0,    0,    0,  //
                            0x02, 0x01, 7,    0,    0,    0,                    //
                            0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11,     //
                            1,    0,    0,    0,    0,    0,    0,    0,    0xAB, 0xCD}));
  EXPECT_EQ(out.size(), message_record_size(data.size()));
}

TEST(Encode, MessageIndexByHand) {
  const MessageIndexEntry entry{5, 9};
  Buffer out;
  append_message_index(out, 3, std::span(&entry, 1));
  EXPECT_EQ(out, from_ints({0x07, 22, 0, 0, 0, 0, 0, 0, 0, 3, 0, 16, 0, 0, 0,  //
                            5,    0,  0, 0, 0, 0, 0, 0, 9, 0, 0, 0,  0, 0, 0, 0}));
}

TEST(Parse, EveryRecordComesBackAsItWent) {
  Buffer out;
  append(out, Channel{4, 2, "rt/ann/x", "cdr", {{"k", "v"}, {"offered_qos_profiles", ""}}});
  ChunkIndex index{1, 2, 3, 4, {{5, 6}, {7, 8}}, 9, "zstd", 10, 11};
  append(out, index);
  append(out, Statistics{1, 2, 3, 4, 5, 6, 7, 8, {{9, 10}}});
  append(out, Metadata{"vpdr", {{"walker", "ann"}}});

  Content rest = out;
  const std::optional<Channel> channel = parse_channel(take_record(rest)->content);
  ASSERT_TRUE(channel);
  EXPECT_EQ(channel->topic, "rt/ann/x");
  EXPECT_EQ(channel->metadata.at("k"), "v");
  EXPECT_EQ(channel->metadata.size(), 2U);
  const std::optional<ChunkIndex> parsed = parse_chunk_index(take_record(rest)->content);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->message_index_offsets, index.message_index_offsets);
  EXPECT_EQ(parsed->uncompressed_size, 11U);
  const std::optional<Statistics> statistics = parse_statistics(take_record(rest)->content);
  ASSERT_TRUE(statistics);
  EXPECT_EQ(statistics->end_ns, 8);
  EXPECT_EQ(statistics->channel_message_counts.at(9), 10U);
  EXPECT_EQ(parse_metadata(take_record(rest)->content)->entries.at("walker"), "ann");
  EXPECT_TRUE(rest.empty());
}

TEST(Parse, NoPrefixOfARecordIsTakenForTheRecord) {
  Buffer out;
  append(out, Channel{4, 2, "rt/ann/x", "cdr", {{"k", "v"}}});
  for (std::size_t size = 0; size < out.size(); ++size) {
    Content cut = Content(out).first(size);
    EXPECT_FALSE(take_record(cut)) << size;
    if (size >= kRecordPrefixBytes) {
      EXPECT_FALSE(parse_channel(Content(out).subspan(kRecordPrefixBytes, size - 9))) << size;
    }
  }
}

TEST(Decompress, RefusesABombByItsSize) {
  Buffer buffer;
  const ChunkView bomb{0, 0, std::uint64_t{1} << 40U, 0, "zstd", {}};
  EXPECT_FALSE(decompress(bomb, 1024, buffer));
  EXPECT_LE(buffer.capacity(), 1024U);
}

TEST(Decompress, RefusesWhatItDoesNotRead) {
  Buffer buffer;
  const auto plain = decompress({0, 0, 0, 0, "lz4", {}}, 1024, buffer);
  ASSERT_FALSE(plain);
  EXPECT_NE(plain.error().message.find("lz4"), std::string::npos);
}

}  // namespace
}  // namespace vpdr::mcap
