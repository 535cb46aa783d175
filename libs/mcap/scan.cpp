#include "mcap/scan.hpp"

#include <algorithm>
#include <array>

namespace vpdr::mcap {
namespace {

/// Messages outside chunks are gathered in segments of about this size.
constexpr std::uint64_t kLooseSegmentBytes = std::uint64_t{4} << 20U;

const char* name_of(Opcode opcode) {
  switch (opcode) {
    case Opcode::kSchema:
      return "schema";
    case Opcode::kChannel:
      return "channel";
    case Opcode::kMessage:
      return "message";
    case Opcode::kChunk:
      return "chunk";
    case Opcode::kMessageIndex:
      return "message index";
    default:
      return "record";
  }
}

class Scanner {
 public:
  Scanner(const Source& source, const ReaderOptions& options, Contents& contents)
      : source_(source), options_(options), contents_(contents) {}

  void run(std::uint64_t offset) {
    offset_ = offset;
    while (step()) contents_.readable_bytes = offset_;
    finish_loose();
    contents_.statistics.schema_count = static_cast<std::uint16_t>(contents_.schemas.size());
    contents_.statistics.channel_count = static_cast<std::uint32_t>(contents_.channels.size());
  }

 private:
  bool step();
  bool stop(std::string reason);
  void take(Opcode opcode, std::uint64_t length);
  void take_chunk(std::uint64_t length);
  void take_loose(std::uint64_t length);
  void take_metadata(std::uint64_t length);
  void take_inner(const RecordView& record, Segment& segment, std::uint64_t& orphans);
  void count(const Message& message, Segment& segment);
  void finish_loose();
  void add_damage(std::uint64_t length, std::string reason) {
    contents_.damage.push_back({offset_, length, std::move(reason)});
  }

  const Source& source_;
  const ReaderOptions& options_;
  Contents& contents_;
  LoadedSegment loaded_;
  std::uint64_t offset_ = 0;
  std::optional<Segment> loose_;
};

bool Scanner::stop(std::string reason) {
  contents_.incomplete = std::move(reason);
  return false;
}

bool Scanner::step() {
  const std::uint64_t left = source_.size() - offset_;
  if (left == 0) return stop("the file ends without the end of its data");
  std::array<std::byte, kRecordPrefixBytes> prefix{};
  if (left < prefix.size() || !source_.read(offset_, prefix)) {
    return stop("the file ends inside a record");
  }
  ByteReader r(prefix);
  const auto opcode = static_cast<Opcode>(r.integer<std::uint8_t>());
  const auto length = r.integer<std::uint64_t>();
  if (static_cast<std::uint8_t>(opcode) == 0) return stop("there is no record where one should be");
  if (length > left - kRecordPrefixBytes) {
    return stop(std::string("the file ends inside a ") + name_of(opcode));
  }
  if (opcode == Opcode::kDataEnd || opcode == Opcode::kFooter) return false;
  take(opcode, kRecordPrefixBytes + length);
  offset_ += kRecordPrefixBytes + length;
  return true;
}

void Scanner::take(Opcode opcode, std::uint64_t length) {
  switch (opcode) {
    case Opcode::kChunk:
      finish_loose();
      take_chunk(length);
      break;
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMessage:
      take_loose(length);
      break;
    case Opcode::kMetadata:
      finish_loose();
      take_metadata(length);
      break;
    case Opcode::kAttachment:
      finish_loose();
      ++contents_.statistics.attachment_count;
      break;
    default:
      finish_loose();
      break;
  }
}

void Scanner::take_chunk(std::uint64_t length) {
  Segment segment{offset_, length, true, 0, 0, 0, {}};
  if (const Status status = load(source_, segment, options_, loaded_); !status) {
    add_damage(length, status.error().message);
    return;
  }
  segment.uncompressed_size = loaded_.records.size();
  ++contents_.statistics.chunk_count;
  const char* compression = loaded_.records.data() == loaded_.plain_bytes.data() ? "zstd" : "none";
  if (contents_.compression.empty()) contents_.compression = compression;
  if (contents_.compression != compression) contents_.compression = "none and zstd";
  std::uint64_t orphans = 0;
  Content rest = loaded_.records;
  while (!rest.empty()) {
    const std::optional<RecordView> record = take_record(rest);
    if (!record) {
      add_damage(length, "the last record of the chunk is cut short");
      break;
    }
    take_inner(*record, segment, orphans);
  }
  if (orphans > 0) {
    add_damage(length, std::to_string(orphans) + " messages of channels that are not described");
  }
  if (!segment.channels.empty()) contents_.segments.push_back(std::move(segment));
}

void Scanner::take_inner(const RecordView& record, Segment& segment, std::uint64_t& orphans) {
  if (record.opcode == Opcode::kSchema) {
    if (std::optional<Schema> schema = parse_schema(record.content)) {
      contents_.schemas.insert_or_assign(schema->id, std::move(*schema));
    }
  } else if (record.opcode == Opcode::kChannel) {
    if (std::optional<Channel> channel = parse_channel(record.content)) {
      contents_.channels.insert_or_assign(channel->id, std::move(*channel));
    }
  } else if (record.opcode == Opcode::kMessage) {
    const std::optional<Message> message = parse_message(record.content);
    if (message && contents_.channels.contains(message->channel_id)) {
      count(*message, segment);
    } else {
      ++orphans;
    }
  }
}

void Scanner::count(const Message& message, Segment& segment) {
  const TimestampNs time = message.log_time_ns;
  const bool first_inside = segment.channels.empty();
  segment.start_ns = first_inside ? time : std::min(segment.start_ns, time);
  segment.end_ns = first_inside ? time : std::max(segment.end_ns, time);
  segment.channels.insert(message.channel_id);
  Statistics& statistics = contents_.statistics;
  const bool first = statistics.message_count == 0;
  statistics.start_ns = first ? time : std::min(statistics.start_ns, time);
  statistics.end_ns = first ? time : std::max(statistics.end_ns, time);
  ++statistics.message_count;
  ++statistics.channel_message_counts[message.channel_id];
}

void Scanner::take_loose(std::uint64_t length) {
  LoadedSegment one;
  if (const Status status = load(source_, {offset_, length, false, 0, 0, 0, {}}, options_, one);
      !status) {
    finish_loose();
    add_damage(length, status.error().message);
    return;
  }
  if (loose_ && loose_->length + length > kLooseSegmentBytes) finish_loose();
  if (!loose_) loose_ = Segment{offset_, 0, false, 0, 0, 0, {}};
  loose_->length += length;
  loose_->uncompressed_size = loose_->length;
  Content bytes = one.records;
  std::uint64_t orphans = 0;
  if (const std::optional<RecordView> record = take_record(bytes)) {
    take_inner(*record, *loose_, orphans);
  }
  if (orphans > 0) add_damage(length, "a message of a channel that is not described");
}

void Scanner::take_metadata(std::uint64_t length) {
  LoadedSegment one;
  const Status status = load(source_, {offset_, length, false, 0, 0, 0, {}}, options_, one);
  Content bytes = one.records;
  const std::optional<RecordView> record = status ? take_record(bytes) : std::nullopt;
  std::optional<Metadata> metadata = record ? parse_metadata(record->content) : std::nullopt;
  if (!metadata) {
    add_damage(length, "metadata record is damaged");
    return;
  }
  ++contents_.statistics.metadata_count;
  contents_.metadata.push_back(std::move(*metadata));
}

void Scanner::finish_loose() {
  if (loose_ && !loose_->channels.empty()) contents_.segments.push_back(std::move(*loose_));
  loose_.reset();
}

}  // namespace

void scan(const Source& source, const ReaderOptions& options, std::uint64_t offset,
          Contents& contents) {
  Scanner(source, options, contents).run(offset);
}

}  // namespace vpdr::mcap
