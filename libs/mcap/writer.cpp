#include "mcap/writer.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "mcap/chunk_builder.hpp"
#include "mcap/crc32.hpp"
#include "mcap/encode.hpp"
#include "mcap/output_file.hpp"
#include "mcap/summary.hpp"

namespace vpdr::mcap {

class Writer::Implementation {
 public:
  Implementation(OutputFile file, WriterOptions options)
      : file_(std::move(file)), options_(std::move(options)) {}
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() { static_cast<void>(close()); }

  Status begin();
  Result<std::uint16_t> add_schema(Schema schema);
  Result<std::uint16_t> add_channel(Channel channel);
  Status write(const Message& message);
  Status write(const Metadata& metadata);
  Status flush();
  Status close();

  [[nodiscard]] const Summary& summary() const { return summary_; }
  [[nodiscard]] std::uint64_t bytes_in_file() const { return file_.size(); }

 private:
  Status append_data(const Buffer& bytes);
  Status append_summary();
  Status fail(Error error);
  void count_chunk(ChunkIndex index);

  OutputFile file_;
  WriterOptions options_;
  Summary summary_;
  ChunkBuilder chunk_;
  Buffer buffer_;
  Crc32 data_crc_;
  std::optional<Error> error_;    ///< the first that happened
  std::optional<Status> closed_;  ///< what close() gave
};

Status Writer::Implementation::begin() {
  buffer_.clear();
  ByteWriter(buffer_).bytes(std::as_bytes(std::span(kMagic)));
  append(buffer_, Header{options_.profile, options_.library});
  return append_data(buffer_);
}

Status Writer::Implementation::fail(Error error) {
  if (!error_) error_ = std::move(error);
  return *error_;
}

Status Writer::Implementation::append_data(const Buffer& bytes) {
  if (const Status status = file_.append(bytes); !status) return fail(status.error());
  data_crc_.update(bytes);
  return Done{};
}

Result<std::uint16_t> Writer::Implementation::add_schema(Schema schema) {
  if (error_) return *error_;
  for (const auto& [id, known] : summary_.schemas) {
    if (known.name == schema.name && known.encoding == schema.encoding &&
        known.text == schema.text) {
      return id;
    }
  }
  if (summary_.schemas.size() >= std::numeric_limits<std::uint16_t>::max()) {
    return Error{"an MCAP file holds at most 65535 schemas"};
  }
  schema.id = static_cast<std::uint16_t>(summary_.schemas.size() + 1);
  chunk_.add(schema);
  const std::uint16_t id = schema.id;
  summary_.schemas.emplace(id, std::move(schema));
  return id;
}

Result<std::uint16_t> Writer::Implementation::add_channel(Channel channel) {
  if (error_) return *error_;
  if (channel.schema_id != 0 && !summary_.schemas.contains(channel.schema_id)) {
    return Error{"channel " + channel.topic + " names the schema " +
                 std::to_string(channel.schema_id) + ", which was not added"};
  }
  if (summary_.channels.size() >= std::numeric_limits<std::uint16_t>::max()) {
    return Error{"an MCAP file holds at most 65535 channels"};
  }
  channel.id = static_cast<std::uint16_t>(summary_.channels.size() + 1);
  chunk_.add(channel);
  const std::uint16_t id = channel.id;
  summary_.channels.emplace(id, std::move(channel));
  return id;
}

Status Writer::Implementation::write(const Message& message) {
  if (error_) return *error_;
  if (!summary_.channels.contains(message.channel_id)) {
    return Error{"message of channel " + std::to_string(message.channel_id) +
                 ", which was not added"};
  }
  if (message.log_time_ns < 0 || message.publish_time_ns < 0) {
    return Error{"message of channel " + std::to_string(message.channel_id) +
                 " has a time before 1970"};
  }
  const std::uint64_t size = chunk_.size() + message_record_size(message.data.size());
  const bool full = chunk_.message_count() > 0 &&
                    (size > options_.chunk_bytes ||
                     chunk_.span_with(message.log_time_ns) >= options_.chunk_duration_ns);
  if (full) {
    if (Status status = flush(); !status) return status;
  }
  chunk_.add(message);
  return Done{};
}

Status Writer::Implementation::write(const Metadata& metadata) {
  if (Status status = flush(); !status) return status;
  const std::uint64_t offset = file_.size();
  buffer_.clear();
  append(buffer_, metadata);
  if (Status status = append_data(buffer_); !status) return status;
  summary_.metadata_indexes.push_back({offset, buffer_.size(), metadata.name});
  ++summary_.statistics.metadata_count;
  return Done{};
}

Status Writer::Implementation::flush() {
  if (error_) return *error_;
  if (chunk_.empty()) return Done{};
  buffer_.clear();
  const int level = options_.compression == Compression::kZstd ? options_.zstd_level : 0;
  Result<ChunkIndex> index = chunk_.encode(level, file_.size(), buffer_);
  if (!index) return fail(index.error());
  if (Status status = append_data(buffer_); !status) return status;
  count_chunk(std::move(index.value()));
  chunk_.clear();
  if (options_.sync == SyncPolicy::kEachChunk) {
    if (const Status status = file_.sync(); !status) return fail(status.error());
  }
  return Done{};
}

void Writer::Implementation::count_chunk(ChunkIndex index) {
  Statistics& statistics = summary_.statistics;
  if (chunk_.message_count() > 0) {
    const bool first = statistics.message_count == 0;
    statistics.start_ns = first ? index.start_ns : std::min(statistics.start_ns, index.start_ns);
    statistics.end_ns = first ? index.end_ns : std::max(statistics.end_ns, index.end_ns);
  }
  for (const auto& [channel, entries] : chunk_.indexes()) {
    statistics.channel_message_counts[channel] += entries.size();
  }
  statistics.message_count += chunk_.message_count();
  ++statistics.chunk_count;
  summary_.chunk_indexes.push_back(std::move(index));
}

Status Writer::Implementation::append_summary() {
  const std::uint64_t data_size = file_.size();
  buffer_.clear();
  append(buffer_, DataEnd{data_crc_.value()});
  append_summary_section(summary_, data_size + buffer_.size(), buffer_);
  ByteWriter(buffer_).bytes(std::as_bytes(std::span(kMagic)));
  return file_.append(buffer_);
}

Status Writer::Implementation::close() {
  if (closed_) return *closed_;
  static_cast<void>(flush());  // an error is kept in error_
  // After a full disk the summary may fit where the last chunk did not: the file is whole then.
  if (file_.size() > 0) {
    if (const Status status = append_summary(); !status) static_cast<void>(fail(status.error()));
  }
  if (options_.sync != SyncPolicy::kNever) {
    if (const Status status = file_.sync(); !status) static_cast<void>(fail(status.error()));
  }
  if (const Status status = file_.close(); !status) static_cast<void>(fail(status.error()));
  closed_ = error_ ? Status(*error_) : Status(Done{});
  return *closed_;
}

Result<Writer> Writer::create(const std::filesystem::path& path, const WriterOptions& options) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  auto implementation = std::make_unique<Implementation>(std::move(file.value()), options);
  if (const Status status = implementation->begin(); !status) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);  // it is empty, and ours
    return status.error();
  }
  return Writer(std::move(implementation));
}

Writer::Writer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Writer::Writer(Writer&&) noexcept = default;
Writer& Writer::operator=(Writer&&) noexcept = default;
Writer::~Writer() = default;

Result<std::uint16_t> Writer::add_schema(std::string_view name, std::string_view encoding,
                                         std::string_view text) {
  return implementation_->add_schema(
      {0, std::string(name), std::string(encoding), std::string(text)});
}

Result<std::uint16_t> Writer::add_channel(Channel channel) {
  return implementation_->add_channel(std::move(channel));
}

Status Writer::write(const Message& message) { return implementation_->write(message); }
Status Writer::write(const Metadata& metadata) { return implementation_->write(metadata); }
Status Writer::flush() { return implementation_->flush(); }
Status Writer::close() { return implementation_->close(); }

const Statistics& Writer::statistics() const { return implementation_->summary().statistics; }

std::uint64_t Writer::messages_in_file(std::uint16_t channel_id) const {
  const auto& counts = statistics().channel_message_counts;
  const auto found = counts.find(channel_id);
  return found == counts.end() ? 0 : found->second;
}

std::uint64_t Writer::bytes_in_file() const { return implementation_->bytes_in_file(); }

}  // namespace vpdr::mcap
