#include "mcap/parse.hpp"

#include <zstd.h>

#include "mcap/bytes.hpp"
#include "mcap/crc32.hpp"

namespace vpdr::mcap {
namespace {

template <class T>
std::optional<T> checked(const ByteReader& reader, T record) {
  if (!reader.ok()) return std::nullopt;
  return record;
}

// Fields are read in the order in which the braces list them, which the language guarantees.
std::map<std::uint16_t, std::uint64_t> read_counts(ByteReader& r) {
  std::map<std::uint16_t, std::uint64_t> counts;
  ByteReader pairs(r.bytes(r.integer<std::uint32_t>()));
  while (pairs.remaining() >= 10) {
    const auto channel = pairs.integer<std::uint16_t>();
    counts[channel] = pairs.integer<std::uint64_t>();
  }
  if (pairs.remaining() > 0) r.bytes(r.remaining() + std::uint64_t{1});  // not whole pairs: damage
  return counts;
}

}  // namespace

std::optional<Header> parse_header(Content content) {
  ByteReader r(content);
  Header h{std::string(r.string()), std::string(r.string())};
  return checked(r, std::move(h));
}

std::optional<Footer> parse_footer(Content content) {
  ByteReader r(content);
  Footer f{r.integer<std::uint64_t>(), r.integer<std::uint64_t>(), r.integer<std::uint32_t>()};
  return checked(r, f);
}

std::optional<Schema> parse_schema(Content content) {
  ByteReader r(content);
  Schema s{r.integer<std::uint16_t>(), std::string(r.string()), std::string(r.string()),
           std::string(r.string())};
  return checked(r, std::move(s));
}

std::optional<Channel> parse_channel(Content content) {
  ByteReader r(content);
  Channel c{r.integer<std::uint16_t>(), r.integer<std::uint16_t>(), std::string(r.string()),
            std::string(r.string()), r.map()};
  return checked(r, std::move(c));
}

std::optional<Message> parse_message(Content content) {
  ByteReader r(content);
  Message m{r.integer<std::uint16_t>(), r.integer<std::uint32_t>(), r.time(), r.time(), {}};
  m.data = r.bytes(r.remaining());
  return checked(r, m);
}

std::optional<ChunkView> parse_chunk(Content content) {
  ByteReader r(content);
  ChunkView c{r.time(),   r.time(), r.integer<std::uint64_t>(), r.integer<std::uint32_t>(),
              r.string(), {}};
  c.records = r.bytes(r.integer<std::uint64_t>());
  return checked(r, c);
}

std::optional<ChunkIndex> parse_chunk_index(Content content) {
  ByteReader r(content);
  ChunkIndex c;
  c.start_ns = r.time();
  c.end_ns = r.time();
  c.chunk_offset = r.integer<std::uint64_t>();
  c.chunk_length = r.integer<std::uint64_t>();
  c.message_index_offsets = read_counts(r);
  c.message_index_length = r.integer<std::uint64_t>();
  c.compression = r.string();
  c.compressed_size = r.integer<std::uint64_t>();
  c.uncompressed_size = r.integer<std::uint64_t>();
  return checked(r, std::move(c));
}

std::optional<Statistics> parse_statistics(Content content) {
  ByteReader r(content);
  Statistics s;
  s.message_count = r.integer<std::uint64_t>();
  s.schema_count = r.integer<std::uint16_t>();
  s.channel_count = r.integer<std::uint32_t>();
  s.attachment_count = r.integer<std::uint32_t>();
  s.metadata_count = r.integer<std::uint32_t>();
  s.chunk_count = r.integer<std::uint32_t>();
  s.start_ns = r.time();
  s.end_ns = r.time();
  s.channel_message_counts = read_counts(r);
  return checked(r, std::move(s));
}

std::optional<Metadata> parse_metadata(Content content) {
  ByteReader r(content);
  Metadata m{std::string(r.string()), r.map()};
  return checked(r, std::move(m));
}

std::optional<MetadataIndex> parse_metadata_index(Content content) {
  ByteReader r(content);
  MetadataIndex m{r.integer<std::uint64_t>(), r.integer<std::uint64_t>(), std::string(r.string())};
  return checked(r, std::move(m));
}

std::optional<DataEnd> parse_data_end(Content content) {
  ByteReader r(content);
  DataEnd d{r.integer<std::uint32_t>()};
  return checked(r, d);
}

std::optional<RecordView> take_record(Content& bytes) {
  ByteReader r(bytes);
  RecordView record;
  record.opcode = static_cast<Opcode>(r.integer<std::uint8_t>());
  record.content = r.bytes(r.integer<std::uint64_t>());
  if (!r.ok()) return std::nullopt;
  bytes = bytes.subspan(kRecordPrefixBytes + record.content.size());
  return record;
}

Result<Content> decompress(const ChunkView& chunk, std::uint64_t max_bytes,
                           std::vector<std::byte>& buffer) {
  Content plain = chunk.records;
  if (chunk.compression == "zstd") {
    if (chunk.uncompressed_size > max_bytes) {
      return Error{"chunk of " + std::to_string(chunk.uncompressed_size) +
                   " bytes is larger than the limit of " + std::to_string(max_bytes)};
    }
    buffer.resize(static_cast<std::size_t>(chunk.uncompressed_size));
    const std::size_t size =
        ZSTD_decompress(buffer.data(), buffer.size(), chunk.records.data(), chunk.records.size());
    if (ZSTD_isError(size) != 0) {
      return Error{std::string("zstd cannot decompress the chunk: ") + ZSTD_getErrorName(size)};
    }
    plain = Content(buffer.data(), size);
  } else if (!chunk.compression.empty()) {
    return Error{"compression '" + std::string(chunk.compression) +
                 "' is not read here, only zstd and none"};
  }
  if (plain.size() != chunk.uncompressed_size) {
    return Error{"chunk has " + std::to_string(plain.size()) + " bytes, its record says " +
                 std::to_string(chunk.uncompressed_size)};
  }
  if (chunk.uncompressed_crc != 0 && crc32(plain) != chunk.uncompressed_crc) {
    return Error{"chunk's CRC does not agree with its bytes"};
  }
  return plain;
}

}  // namespace vpdr::mcap
