#pragma once
// Bytes to records. Each parser takes the content of one record (without its prefix) and gives
// nothing when a length or a field runs past the end; longer content than known is accepted, as
// the format asks of readers. Views point into the content.
#include <optional>
#include <span>

#include "core/result.hpp"
#include "mcap/records.hpp"

namespace vpdr::mcap {

using Content = std::span<const std::byte>;

[[nodiscard]] std::optional<Header> parse_header(Content content);
[[nodiscard]] std::optional<Footer> parse_footer(Content content);
[[nodiscard]] std::optional<Schema> parse_schema(Content content);
[[nodiscard]] std::optional<Channel> parse_channel(Content content);
[[nodiscard]] std::optional<Message> parse_message(Content content);
[[nodiscard]] std::optional<ChunkView> parse_chunk(Content content);
[[nodiscard]] std::optional<ChunkIndex> parse_chunk_index(Content content);
[[nodiscard]] std::optional<Statistics> parse_statistics(Content content);
[[nodiscard]] std::optional<Metadata> parse_metadata(Content content);
[[nodiscard]] std::optional<MetadataIndex> parse_metadata_index(Content content);
[[nodiscard]] std::optional<DataEnd> parse_data_end(Content content);

/// One record inside a buffer.
struct RecordView {
  Opcode opcode = Opcode::kHeader;
  std::uint64_t offset = 0;  ///< of the record's prefix in the buffer
  Content content;
};

/// Takes the next record off the front of `bytes`; nothing when it is cut short.
[[nodiscard]] std::optional<RecordView> take_record(Content& bytes);

/// Uncompressed records of a chunk, in `buffer` or in the chunk itself. Refuses a compression that
/// is not read here, a size above `max_bytes`, a size or CRC that does not agree.
[[nodiscard]] Result<Content> decompress(const ChunkView& chunk, std::uint64_t max_bytes,
                                         std::vector<std::byte>& buffer);

}  // namespace vpdr::mcap
