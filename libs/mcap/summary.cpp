#include "mcap/summary.hpp"

#include "mcap/crc32.hpp"
#include "mcap/encode.hpp"

namespace vpdr::mcap {
namespace {

// Footer content that its CRC covers: all but the CRC itself.
constexpr std::size_t kFooterBytesUnderCrc = kRecordPrefixBytes + 8 + 8;

/// Notes where each group of records lies while they are appended.
class GroupWriter {
 public:
  GroupWriter(Buffer& out, std::uint64_t file_offset)
      : out_(out), first_(out.size()), file_offset_(file_offset) {}

  template <class AppendAll>
  void group(Opcode opcode, AppendAll append_all) {
    const std::uint64_t start = position();
    append_all(out_);
    if (position() > start) offsets_.push_back({opcode, start, position() - start});
  }
  [[nodiscard]] std::uint64_t position() const { return file_offset_ + out_.size() - first_; }
  [[nodiscard]] const std::vector<SummaryOffset>& offsets() const { return offsets_; }

 private:
  Buffer& out_;
  std::size_t first_;
  std::uint64_t file_offset_;
  std::vector<SummaryOffset> offsets_;
};

}  // namespace

void append_summary_section(const Summary& summary, std::uint64_t file_offset, Buffer& out) {
  const std::size_t first = out.size();
  Statistics statistics = summary.statistics;
  statistics.schema_count = static_cast<std::uint16_t>(summary.schemas.size());
  statistics.channel_count = static_cast<std::uint32_t>(summary.channels.size());

  GroupWriter groups(out, file_offset);
  groups.group(Opcode::kSchema, [&](Buffer& b) {
    for (const auto& [id, schema] : summary.schemas) append(b, schema);
  });
  groups.group(Opcode::kChannel, [&](Buffer& b) {
    for (const auto& [id, channel] : summary.channels) append(b, channel);
  });
  groups.group(Opcode::kStatistics, [&](Buffer& b) { append(b, statistics); });
  groups.group(Opcode::kChunkIndex, [&](Buffer& b) {
    for (const ChunkIndex& index : summary.chunk_indexes) append(b, index);
  });
  groups.group(Opcode::kMetadataIndex, [&](Buffer& b) {
    for (const MetadataIndex& index : summary.metadata_indexes) append(b, index);
  });
  Footer footer{file_offset, groups.position(), 0};
  for (const SummaryOffset& offset : groups.offsets()) append(out, offset);

  const std::size_t footer_at = out.size();
  append(out, footer);
  const std::size_t covered = footer_at + kFooterBytesUnderCrc - first;
  footer.summary_crc = crc32(Content(out).subspan(first, covered));
  out.resize(footer_at);
  append(out, footer);
}

Result<Summary> parse_summary_section(Content records) {
  Summary summary;
  while (!records.empty()) {
    const std::optional<RecordView> record = take_record(records);
    if (!record) return Error{"a record of the summary is cut short"};
    bool good = true;
    const auto keep = [&good](auto parsed, auto store) {
      good = parsed.has_value();
      if (good) store(std::move(*parsed));
    };
    switch (record->opcode) {
      case Opcode::kSchema:
        keep(parse_schema(record->content),
             [&](Schema s) { summary.schemas.insert_or_assign(s.id, std::move(s)); });
        break;
      case Opcode::kChannel:
        keep(parse_channel(record->content),
             [&](Channel c) { summary.channels.insert_or_assign(c.id, std::move(c)); });
        break;
      case Opcode::kStatistics:
        keep(parse_statistics(record->content),
             [&](Statistics s) { summary.statistics = std::move(s); });
        break;
      case Opcode::kChunkIndex:
        keep(parse_chunk_index(record->content),
             [&](ChunkIndex c) { summary.chunk_indexes.push_back(std::move(c)); });
        break;
      case Opcode::kMetadataIndex:
        keep(parse_metadata_index(record->content),
             [&](MetadataIndex m) { summary.metadata_indexes.push_back(std::move(m)); });
        break;
      default:
        break;
    }
    if (!good) return Error{"a record of the summary is damaged"};
  }
  return summary;
}

}  // namespace vpdr::mcap
