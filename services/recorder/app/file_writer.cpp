#include "recorder/app/file_writer.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/errors.hpp"
#include "dds/schema.hpp"
#include "mcap/topic_counters.hpp"
#include "recorder/app/qos_profile.hpp"

namespace vpdr::recorder {
namespace {

constexpr std::chrono::milliseconds kLongestWait{200};

/// Makes the folder, and with `replace` removes what stands in the file's place.
void prepare(const std::filesystem::path& path, bool replace) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) {
    throw FileFault(path.parent_path().string() + ": cannot create the folder: " + error.message() +
                    "; choose another with --out");
  }
  if (replace && std::filesystem::is_regular_file(path, error)) {
    std::filesystem::remove(path, error);
  }
}

/// Name that ROS 2 and its tools give the topic "rt/ann/imu/data".
std::string ros_name(const std::string& dds_topic) { return dds_topic.substr(2); }

}  // namespace

FileWriter::FileWriter(const RecorderSettings& settings, std::filesystem::path path,
                       TopicTable& topics, const mcap::StringMap& walk, OnFailure on_failure)
    : path_(std::move(path)),
      flush_every_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(settings.chunk_s))),
      topics_(topics),
      on_failure_(std::move(on_failure)),
      queue_(std::size_t{settings.queue_mib} << 20U) {
  prepare(path_, settings.replace);
  Result<mcap::Writer> writer = mcap::Writer::create(path_, writer_options(settings));
  if (!writer) {
    const bool exists = std::filesystem::exists(path_);
    throw FileFault(writer.error().message + (exists ? ", or give --replace" : ""));
  }
  writer_.emplace(std::move(writer.value()));
  if (const Status status = writer_->write(mcap::Metadata{mcap::kWalkRecord, walk}); !status) {
    throw FileFault(status.error().message);
  }
  thread_ = std::jthread([this] { run(); });
}

FileWriter::~FileWriter() { finish(); }

void FileWriter::run() {
  while (queue_.take(
      batch_, std::min(kLongestWait,
                       std::chrono::duration_cast<std::chrono::milliseconds>(flush_every_)))) {
    add_new_topics();
    write(batch_);
    flush_when_due();
    count_written();
  }
}

void FileWriter::add_new_topics() {
  const std::size_t known = topics_.size();
  while (!failed_ && channels_.size() < known) {
    channels_.push_back(add_topic(topics_.description(channels_.size())));
  }
}

std::uint16_t FileWriter::add_topic(const TopicDescription& description) {
  const dds::WriterInfo& writer = description.writer;
  const std::string text = dds::ros2msg_schema(writer.type);
  // A type that is not vpdr's keeps its name; nobody can say here what it consists of.
  const auto schema = writer_->add_schema(writer.type, text.empty() ? "" : "ros2msg", text);
  if (!schema) {
    fail(schema.error().message);
    return 0;
  }
  const auto channel = writer_->add_channel(
      {0,
       schema.value(),
       ros_name(writer.topic),
       "cdr",
       {{"offered_qos_profiles", offered_qos_profiles(writer)}, {"dds_topic", writer.topic}}});
  if (!channel) {
    fail(channel.error().message);
    return 0;
  }
  return channel.value();
}

void FileWriter::write(const Batch& batch) {
  for (const QueuedSample& sample : batch.samples) {
    if (failed_) return;
    check(writer_->write(mcap::Message{channels_[sample.topic], sample.sequence, sample.log_time_ns,
                                       sample.publish_time_ns, batch.payload_of(sample)}));
  }
}

void FileWriter::flush_when_due() {
  const std::uint32_t chunks = writer_->statistics().chunk_count;
  if (std::exchange(chunks_, chunks) != chunks) last_chunk_ = Clock::now();
  if (failed_ || Clock::now() - last_chunk_ < flush_every_) return;
  check(writer_->flush());
}

void FileWriter::count_written() {
  for (std::size_t topic = 0; topic < channels_.size(); ++topic) {
    topics_.written(topic, writer_->messages_in_file(channels_[topic]));
  }
  bytes_in_file_ = writer_->bytes_in_file();
}

void FileWriter::check(const Status& status) {
  if (!status) fail(status.error().message);
}

void FileWriter::fail(const std::string& message) {
  if (failed_.exchange(true)) return;
  on_failure_(message + ". What was recorded until then is kept and readable: recorder info " +
              path_.string());
}

void FileWriter::finish() {
  if (!thread_.joinable()) return;
  queue_.close();
  thread_.join();
  add_new_topics();
  if (!failed_) check(writer_->flush());
  count_written();
  mcap::StringMap counters;
  for (const TopicRow& row : topics_.rows()) {
    const TopicStatistics& s = row.statistics;
    mcap::add_counters(row.description.name, {s.received, s.lost, s.before, s.written}, counters);
  }
  if (!failed_) check(writer_->write(mcap::Metadata{mcap::kCountersRecord, counters}));
  const Status closed = writer_->close();
  if (!failed_) check(closed);
  bytes_in_file_ = std::filesystem::file_size(path_);
}

}  // namespace vpdr::recorder
