#include "mcap/reader.hpp"

#include <algorithm>
#include <utility>

#include "mcap/crc32.hpp"
#include "mcap/scan.hpp"
#include "mcap/summary.hpp"

namespace vpdr::mcap {
namespace {

constexpr std::uint64_t kFooterContentBytes = 8 + 8 + 4;
constexpr std::uint64_t kFooterBytes = kRecordPrefixBytes + kFooterContentBytes;
constexpr std::uint64_t kLongestHeader = 1U << 20U;

bool is_magic(std::span<const std::byte> bytes) {
  return std::equal(bytes.begin(), bytes.end(), std::as_bytes(std::span(kMagic)).begin());
}

/// Reads magic and header; gives the offset of the first record after them.
Result<std::uint64_t> read_start(const Source& source, Header& header) {
  std::array<std::byte, kMagic.size() + kRecordPrefixBytes> start{};
  if (source.size() == 0) return Error{"is empty, so no MCAP recording"};
  const bool whole = source.read(0, start);
  if (!whole || !is_magic(std::span(start).first(kMagic.size()))) {
    return Error{"is no MCAP recording: it does not begin with the bytes of one"};
  }
  ByteReader r(std::span<const std::byte>(start).subspan(kMagic.size()));
  const auto opcode = static_cast<Opcode>(r.integer<std::uint8_t>());
  const auto length = r.integer<std::uint64_t>();
  if (opcode != Opcode::kHeader || length > kLongestHeader) {
    return Error{"is no readable MCAP recording: its header is damaged"};
  }
  Buffer content(static_cast<std::size_t>(length));
  std::optional<Header> parsed;
  if (source.read(start.size(), content)) parsed = parse_header(content);
  if (!parsed) return Error{"is no readable MCAP recording: its header is damaged"};
  header = std::move(*parsed);
  return start.size() + length;
}

struct End {
  Footer footer;
  std::uint64_t footer_at = 0;
};

/// Footer and last magic, or why they are not there.
Result<End> read_end(const Source& source) {
  std::array<std::byte, kFooterBytes + kMagic.size()> end{};
  if (source.size() < end.size()) return Error{"the file has no end"};
  const std::uint64_t footer_at = source.size() - end.size();
  if (!source.read(footer_at, end) || !is_magic(std::span(end).last(kMagic.size()))) {
    return Error{"the file was not closed by its writer"};
  }
  Content bytes = std::span<const std::byte>(end).first(kFooterBytes);
  const std::optional<RecordView> record = take_record(bytes);
  const bool is_footer = record && record->opcode == Opcode::kFooter;
  const std::optional<Footer> footer = is_footer ? parse_footer(record->content) : std::nullopt;
  if (!footer) return Error{"the footer is damaged"};
  return End{*footer, footer_at};
}

Result<Summary> read_summary(const Source& source, const ReaderOptions& options, const End& end) {
  const Footer& footer = end.footer;
  if (footer.summary_start > end.footer_at) return Error{"the footer is damaged"};
  if (end.footer_at - footer.summary_start > options.max_chunk_bytes) {
    return Error{"the summary is larger than the limit"};
  }
  // The CRC covers the summary and the footer up to the CRC itself.
  Buffer bytes(static_cast<std::size_t>(end.footer_at + kFooterBytes - 4 - footer.summary_start));
  if (!source.read(footer.summary_start, bytes)) return Error{"the summary cannot be read"};
  if (footer.summary_crc != 0 && crc32(bytes) != footer.summary_crc) {
    return Error{"the summary's CRC does not agree with its bytes"};
  }
  return parse_summary_section(
      Content(bytes).first(static_cast<std::size_t>(end.footer_at - footer.summary_start)));
}

bool lies_inside(std::uint64_t offset, std::uint64_t length, std::uint64_t end) {
  return offset <= end && length <= end - offset;
}

bool has_index(const Summary& summary) {
  return summary.statistics.message_count == 0 || !summary.chunk_indexes.empty();
}

void add_compression(const std::string& compression, std::string& all) {
  const std::string name = compression.empty() ? "none" : compression;
  if (all.find(name) != std::string::npos) return;
  all += all.empty() ? name : " and " + name;
}

/// Segments from the chunk indexes; false when one does not lie in the file.
bool take_chunk_indexes(const Summary& summary, std::uint64_t data_end, Contents& contents) {
  for (const ChunkIndex& index : summary.chunk_indexes) {
    if (!lies_inside(index.chunk_offset, index.chunk_length, data_end)) return false;
    add_compression(index.compression, contents.compression);
    Segment segment{index.chunk_offset, index.chunk_length,      true, index.start_ns,
                    index.end_ns,       index.uncompressed_size, {}};
    for (const auto& [channel, offset] : index.message_index_offsets) {
      segment.channels.insert(channel);
    }
    contents.segments.push_back(std::move(segment));
  }
  std::sort(contents.segments.begin(), contents.segments.end(),
            [](const Segment& a, const Segment& b) { return a.offset < b.offset; });
  return true;
}

void read_metadata(const Source& source, const ReaderOptions& options,
                   const std::vector<MetadataIndex>& indexes, Contents& contents) {
  for (const MetadataIndex& index : indexes) {
    LoadedSegment loaded;
    const Status status =
        load(source, {index.offset, index.length, false, 0, 0, 0, {}}, options, loaded);
    Content bytes = loaded.records;
    const std::optional<RecordView> record = status ? take_record(bytes) : std::nullopt;
    const bool right = record && record->opcode == Opcode::kMetadata;
    std::optional<Metadata> metadata = right ? parse_metadata(record->content) : std::nullopt;
    if (metadata) {
      contents.metadata.push_back(std::move(*metadata));
    } else {
      contents.damage.push_back({index.offset, index.length, "metadata record is damaged"});
    }
  }
}

/// Fills `contents` from the summary; false when it names chunks outside the file.
bool use_summary(const Source& source, const ReaderOptions& options, std::uint64_t data_end,
                 Summary summary, Contents& contents) {
  Contents found = contents;
  if (!take_chunk_indexes(summary, data_end, found)) return false;
  read_metadata(source, options, summary.metadata_indexes, found);
  found.schemas = std::move(summary.schemas);
  found.channels = std::move(summary.channels);
  found.statistics = std::move(summary.statistics);
  found.readable_bytes = source.size();
  found.from_summary = true;
  contents = std::move(found);
  return true;
}

Status read_contents(const Source& source, const ReaderOptions& options, Contents& contents) {
  contents.file_bytes = source.size();
  const Result<std::uint64_t> start = read_start(source, contents.header);
  if (!start) return start.error();
  contents.readable_bytes = start.value();

  const Result<End> end = read_end(source);
  std::string missing = end ? "" : end.error().message;
  // A file may rightly have no summary, or none with chunk indexes; it is read by scanning then.
  if (end && end.value().footer.summary_start != 0) {
    Result<Summary> summary = read_summary(source, options, end.value());
    if (!summary) {
      missing = summary.error().message;
    } else if (has_index(summary.value())) {
      const std::uint64_t data_end = end.value().footer.summary_start;
      if (use_summary(source, options, data_end, std::move(summary.value()), contents)) {
        return Done{};
      }
      missing = "the summary names chunks outside the file";
    }
  }
  scan(source, options, start.value(), contents);
  if (contents.incomplete.empty() && end) contents.readable_bytes = source.size();
  if (contents.incomplete.empty()) contents.incomplete = missing;
  return Done{};
}

}  // namespace

Reader::Reader(std::unique_ptr<Source> source, const ReaderOptions& options)
    : source_(std::move(source)), options_(options) {}

Result<Reader> Reader::open(const std::filesystem::path& path, const ReaderOptions& options) {
  Result<std::unique_ptr<Source>> source = open_file(path);
  if (!source) return source.error();
  Result<Reader> reader = open(std::move(source.value()), options);
  if (!reader) return Error{path.string() + ": " + reader.error().message};
  return reader;
}

Result<Reader> Reader::open(std::unique_ptr<Source> source, const ReaderOptions& options) {
  Reader reader(std::move(source), options);
  const Status status = read_contents(*reader.source_, reader.options_, reader.contents_);
  if (!status) return status.error();
  return reader;
}

const Channel* Reader::find_channel(std::uint16_t id) const {
  const auto found = contents_.channels.find(id);
  return found == contents_.channels.end() ? nullptr : &found->second;
}

const Schema* Reader::schema_of(const Channel& channel) const {
  const auto found = contents_.schemas.find(channel.schema_id);
  return found == contents_.schemas.end() ? nullptr : &found->second;
}

}  // namespace vpdr::mcap
