#include "recorder/app/recording_info.hpp"

#include <algorithm>
#include <map>

#include "core/errors.hpp"
#include "dds/topics.hpp"

namespace vpdr::recorder {
namespace {

const mcap::StringMap* find_record(const mcap::Contents& contents, const char* name) {
  for (const mcap::Metadata& record : contents.metadata) {
    if (record.name == name) return &record.entries;
  }
  return nullptr;
}

/// "imu/data_raw" of "/ann/imu/data_raw".
std::string name_in_counters(const std::string& topic) {
  const auto parts = dds::parse_topic_path("rt" + topic);
  return parts ? parts->name : topic;
}

std::vector<TopicInfo> list_topics(const mcap::Reader& reader) {
  const mcap::Contents& contents = reader.contents();
  const mcap::StringMap* counters = find_record(contents, mcap::kCountersRecord);
  std::vector<TopicInfo> topics;
  for (const auto& [id, channel] : contents.channels) {
    TopicInfo topic;
    topic.topic = channel.topic;
    if (const mcap::Schema* schema = reader.schema_of(channel)) topic.type = schema->name;
    if (counters != nullptr) {
      topic.counters = mcap::find_counters(name_in_counters(channel.topic), *counters);
    }
    topics.push_back(std::move(topic));
  }
  return topics;
}

void count_messages(const mcap::Reader& reader, RecordingInfo& info) {
  std::map<std::uint16_t, TopicInfo*> by_channel;
  std::size_t next = 0;
  for (const auto& [id, channel] : info.contents.channels) by_channel[id] = &info.topics[next++];
  mcap::Selection as_written;
  as_written.order = mcap::Order::kFile;
  mcap::MessageStream stream(reader, as_written);
  while (const std::optional<mcap::Message> message = stream.next()) {
    TopicInfo& topic = *by_channel.at(message->channel_id);
    const TimestampNs time = message->log_time_ns;
    ++topic.messages;
    topic.bytes += message->data.size();
    topic.first_ns = std::min(topic.first_ns.value_or(time), time);
    topic.last_ns = std::max(topic.last_ns.value_or(time), time);
  }
  info.contents.damage.insert(info.contents.damage.end(), stream.damage().begin(),
                              stream.damage().end());
}

}  // namespace

double TopicInfo::rate_hz() const {
  if (messages < 2 || *last_ns == *first_ns) return 0.0;
  return static_cast<double>(messages - 1) / to_seconds(*last_ns - *first_ns);
}

double RecordingInfo::duration_s() const {
  return to_seconds(contents.statistics.end_ns - contents.statistics.start_ns);
}

RecordingInfo inspect(const std::filesystem::path& file) {
  const Result<mcap::Reader> reader = mcap::Reader::open(file);
  if (!reader) throw FileFault(reader.error().message);
  RecordingInfo info;
  info.file = file;
  info.contents = reader.value().contents();
  info.topics = list_topics(reader.value());
  for (const mcap::Segment& segment : info.contents.segments) {
    info.uncompressed_bytes += segment.uncompressed_size;
  }
  const mcap::StringMap* walk = find_record(info.contents, mcap::kWalkRecord);
  if (walk != nullptr && walk->contains("walker")) info.walker = walk->at("walker");
  info.ended_early = walk != nullptr && info.contents.incomplete.empty() &&
                     find_record(info.contents, mcap::kCountersRecord) == nullptr;
  count_messages(reader.value(), info);
  std::sort(info.topics.begin(), info.topics.end(),
            [](const TopicInfo& a, const TopicInfo& b) { return a.topic < b.topic; });
  return info;
}

}  // namespace vpdr::recorder
