#pragma once
// Typed messages out of a recording, by topic.
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "dds/serialize.hpp"
#include "dds/topics.hpp"
#include "mcap/reader.hpp"

namespace vpdr::run_export {

/// Hands each message of the chosen topics to its callback, in the order of their log times. The
/// reader must outlive it. Not thread-safe.
class TopicDispatch {
 public:
  /// `file`: name of the recording for messages.
  TopicDispatch(const mcap::Reader& reader, std::string file)
      : reader_(reader), file_(std::move(file)) {}

  /// `callback(const T&, const mcap::Message&)`. Throws FileFault where the recording has the topic
  /// with another type, or of several walkers.
  template <class T, class Callback>
  void on(const dds::Topic<T>& topic, Callback callback) {
    const mcap::Channel* channel = find(topic.info);
    if (channel == nullptr) return;
    auto message = std::make_shared<T>();
    handlers_[channel->id] = [message, callback](const mcap::Message& raw) {
      if (!dds::deserialize(raw.data, *message)) return false;
      callback(*message, raw);
      return true;
    };
    topics_.insert(channel->topic);
  }

  /// Whether the recording holds messages of the topic.
  [[nodiscard]] bool has(const dds::TopicInfo& topic) const;

  struct Counts {
    std::uint64_t messages = 0;
    std::uint64_t unreadable = 0;
    std::uint64_t damaged_chunks = 0;
  };
  /// Reads them all.
  Counts run();

 private:
  [[nodiscard]] const mcap::Channel* find(const dds::TopicInfo& topic) const;

  const mcap::Reader& reader_;
  std::string file_;
  std::map<std::uint16_t, std::function<bool(const mcap::Message&)>> handlers_;
  std::set<std::string> topics_;
};

/// "imu/data_raw" of "/ann/imu/data_raw"; the topic itself where it is not of that form.
std::string name_without_walker(const std::string& topic);

}  // namespace vpdr::run_export
