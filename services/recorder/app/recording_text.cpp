// How `recorder info` says it.
#include <array>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "recorder/app/recording_info.hpp"

namespace vpdr::recorder {
namespace {

template <class... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  const int size = std::snprintf(nullptr, 0, pattern, arguments...);
  std::string text(static_cast<std::size_t>(size), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, arguments...);
  return text;
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits{"B", "KiB", "MiB", "GiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1024.0 && unit + 1 < kUnits.size()) {
    value /= 1024.0;
    ++unit;
  }
  return format(unit == 0 ? "%.0f %s" : "%.1f %s", value, kUnits[unit]);
}

std::string time_text(TimestampNs ns) {
  const std::time_t seconds = ns / kNsPerSecond;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &utc);
  return text.data();
}

std::string state_text(const mcap::Contents& contents) {
  if (contents.incomplete.empty()) return "complete: closed by its writer";
  const std::uint64_t lost = contents.file_bytes - contents.readable_bytes;
  std::string text = "torn: " + contents.incomplete;
  if (lost == 0) return text + "; nothing of the data is lost by that";
  return text + " at byte " + std::to_string(contents.readable_bytes) + "; the last " +
         size_text(lost) + " cannot be read, everything before them can";
}

std::string compression_text(const RecordingInfo& info) {
  if (info.contents.compression.empty()) return "no chunks";
  const double ratio = info.contents.file_bytes == 0
                           ? 0.0
                           : static_cast<double>(info.uncompressed_bytes) /
                                 static_cast<double>(info.contents.file_bytes);
  return format("%s, %.1f to 1, %zu chunks", info.contents.compression.c_str(), ratio,
                info.contents.segments.size());
}

std::string topic_line(const TopicInfo& t, int topic_width, int type_width) {
  const std::string lost = t.counters ? std::to_string(t.counters->lost) : "?";
  const std::string before = t.counters ? std::to_string(t.counters->before) : "?";
  return format("%-*s  %-*s %9llu %8.1f %6s %6s %10s\n", topic_width, t.topic.c_str(), type_width,
                t.type.c_str(), static_cast<unsigned long long>(t.messages), t.rate_hz(),
                lost.c_str(), before.c_str(), size_text(t.bytes).c_str());
}

}  // namespace

std::string to_text(const RecordingInfo& info) {
  const mcap::Contents& contents = info.contents;
  std::string text = info.file.string() + "\n  " + state_text(contents) + "\n";
  if (info.ended_early) {
    text += "  ended early: the recorder could not write any more, as on a full disk\n";
  }
  for (const mcap::Damage& place : contents.damage) {
    text += "  damaged: " + size_text(place.length) + " at byte " + std::to_string(place.offset) +
            " left out: " + place.reason + "\n";
  }
  text += "  " + size_text(contents.file_bytes) + " (" + compression_text(info) + "), written by " +
          contents.header.library + "\n";
  if (!info.walker.empty()) text += "  walker " + info.walker + "\n";
  if (contents.statistics.message_count > 0) {
    text += "  " + time_text(contents.statistics.start_ns) + ", " +
            format("%.3f s", info.duration_s()) + "\n";
  }
  int topic_width = 5;
  int type_width = 4;
  for (const TopicInfo& topic : info.topics) {
    topic_width = std::max(topic_width, static_cast<int>(topic.topic.size()));
    type_width = std::max(type_width, static_cast<int>(topic.type.size()));
  }
  text += format("%-*s  %-*s %9s %8s %6s %6s %10s\n", topic_width, "topic", type_width, "type",
                 "messages", "rate Hz", "lost", "before", "size");
  for (const TopicInfo& topic : info.topics) text += topic_line(topic, topic_width, type_width);
  if (!contents.incomplete.empty() || info.ended_early) {
    text += "lost and before are written at the end of a recording, which this one has not\n";
  }
  return text;
}

std::string to_json(const RecordingInfo& info) {
  const mcap::Contents& contents = info.contents;
  nlohmann::ordered_json json = {{"file", info.file.string()},
                                 {"complete", contents.incomplete.empty()},
                                 {"incomplete", contents.incomplete},
                                 {"ended_early", info.ended_early},
                                 {"file_bytes", contents.file_bytes},
                                 {"readable_bytes", contents.readable_bytes},
                                 {"uncompressed_bytes", info.uncompressed_bytes},
                                 {"compression", contents.compression},
                                 {"chunks", contents.segments.size()},
                                 {"library", contents.header.library},
                                 {"walker", info.walker},
                                 {"start_ns", contents.statistics.start_ns},
                                 {"duration_s", info.duration_s()},
                                 {"damage", nlohmann::json::array()},
                                 {"topics", nlohmann::json::array()}};
  for (const mcap::Damage& place : contents.damage) {
    json["damage"].push_back(
        {{"offset", place.offset}, {"length", place.length}, {"reason", place.reason}});
  }
  for (const TopicInfo& topic : info.topics) {
    nlohmann::ordered_json entry = {{"topic", topic.topic},
                                    {"type", topic.type},
                                    {"messages", topic.messages},
                                    {"rate_hz", topic.rate_hz()},
                                    {"bytes", topic.bytes}};
    if (topic.counters) {
      entry["received"] = topic.counters->received;
      entry["lost"] = topic.counters->lost;
      entry["before"] = topic.counters->before;
    }
    json["topics"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vpdr::recorder
