#include "mcap/segment.hpp"

namespace vpdr::mcap {

Status load(const Source& source, const Segment& segment, const ReaderOptions& options,
            LoadedSegment& loaded) {
  loaded.records = {};
  // What does not compress is a little longer compressed.
  const std::uint64_t longest = options.max_chunk_bytes + options.max_chunk_bytes / 64 + 4096;
  if (segment.length > longest) {
    return Error{"record of " + std::to_string(segment.length) +
                 " bytes is larger than the limit of " + std::to_string(longest)};
  }
  loaded.file_bytes.resize(static_cast<std::size_t>(segment.length));
  if (!source.read(segment.offset, loaded.file_bytes)) return Error{"cannot be read"};
  if (!segment.is_chunk) {
    loaded.records = loaded.file_bytes;
    return Done{};
  }
  Content bytes = loaded.file_bytes;
  const std::optional<RecordView> record = take_record(bytes);
  if (!record || record->opcode != Opcode::kChunk) return Error{"no chunk where one should be"};
  const std::optional<ChunkView> chunk = parse_chunk(record->content);
  if (!chunk) return Error{"chunk record is damaged"};
  const Result<Content> plain = decompress(*chunk, options.max_chunk_bytes, loaded.plain_bytes);
  if (!plain) return plain.error();
  loaded.records = plain.value();
  const bool copied = loaded.records.data() == loaded.plain_bytes.data();
  if (copied) loaded.file_bytes = Buffer();
  return Done{};
}

}  // namespace vpdr::mcap
