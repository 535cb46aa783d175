#include "run_export/topic_dispatch.hpp"

namespace vpdr::run_export {

std::string name_without_walker(const std::string& topic) {
  const auto parts = dds::parse_topic_path("rt" + topic);
  return parts ? parts->name : topic;
}

const mcap::Channel* TopicDispatch::find(const dds::TopicInfo& topic) const {
  const mcap::Channel* found = nullptr;
  for (const auto& [id, channel] : reader_.contents().channels) {
    if (name_without_walker(channel.topic) != topic.name) continue;
    if (found != nullptr) {
      throw FileFault(file_ + ": holds " + found->topic + " and " + channel.topic +
                      ": record each walker to a file of its own");
    }
    const mcap::Schema* schema = reader_.schema_of(channel);
    if (schema == nullptr || schema->name != topic.type) {
      throw FileFault(file_ + ": topic " + channel.topic + " is of type " +
                      (schema == nullptr ? "unknown" : schema->name) + ", not " +
                      std::string(topic.type) + ": it was not made by vpdr");
    }
    found = &channel;
  }
  return found;
}

bool TopicDispatch::has(const dds::TopicInfo& topic) const {
  const mcap::Channel* channel = find(topic);
  const auto& counts = reader_.contents().statistics.channel_message_counts;
  const auto count = channel == nullptr ? counts.end() : counts.find(channel->id);
  return count != counts.end() && count->second > 0;
}

TopicDispatch::Counts TopicDispatch::run() {
  Counts counts;
  if (topics_.empty()) return counts;
  mcap::Selection selection;
  selection.topics = topics_;
  mcap::MessageStream stream(reader_, selection);
  while (const std::optional<mcap::Message> message = stream.next()) {
    ++counts.messages;
    if (!handlers_.at(message->channel_id)(*message)) ++counts.unreadable;
  }
  counts.damaged_chunks = stream.damage().size();
  return counts;
}

}  // namespace vpdr::run_export
