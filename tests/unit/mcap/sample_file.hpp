#pragma once
// Recordings that the tests write, cut and damage.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mcap/bytes.hpp"
#include "mcap/reader.hpp"
#include "mcap/writer.hpp"

namespace vpdr::mcap::testing {

/// One message as a test compares it.
struct Seen {
  std::string topic;
  std::uint32_t sequence = 0;
  TimestampNs log_time_ns = 0;
  std::string data;
  bool operator==(const Seen&) const = default;
};

inline std::span<const std::byte> as_bytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

inline Buffer read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto bytes = as_bytes(text);
  return {bytes.begin(), bytes.end()};
}

inline std::vector<Seen> read_all(const Reader& reader, Selection selection = {}) {
  std::vector<Seen> all;
  MessageStream stream(reader, std::move(selection));
  while (const std::optional<Message> m = stream.next()) {
    all.push_back({reader.find_channel(m->channel_id)->topic, m->sequence, m->log_time_ns,
                   std::string(reinterpret_cast<const char*>(m->data.data()), m->data.size())});
  }
  return all;
}

inline Reader open(std::span<const std::byte> bytes, const ReaderOptions& options = {}) {
  Result<Reader> reader = Reader::open(open_bytes(bytes), options);
  if (!reader) throw std::runtime_error(reader.error().message);
  return std::move(reader.value());
}

/// Two topics at 100 and 10 messages/s for `seconds`, each message naming itself.
inline std::vector<Seen> write_walk(Writer& writer, int seconds) {
  const auto schema = writer.add_schema("std_msgs/msg/String", "ros2msg", "string data\n").value();
  const auto fast = writer.add_channel({0, schema, "rt/ann/imu/data", "cdr", {}}).value();
  const auto slow = writer.add_channel({0, schema, "rt/ann/fusion/pose", "cdr", {}}).value();
  std::vector<Seen> written;
  for (int i = 0; i < seconds * 100; ++i) {
    const TimestampNs time = kNsPerSecond + i * (kNsPerSecond / 100);
    const auto sequence = static_cast<std::uint32_t>(i + 1);
    const std::string text = "imu " + std::to_string(i);
    if (!writer.write(Message{fast, sequence, time, time - 1000, as_bytes(text)})) return written;
    written.push_back({"rt/ann/imu/data", sequence, time, text});
    if (i % 10 != 0) continue;
    const std::string pose = "pose " + std::to_string(i);
    if (!writer.write(Message{slow, sequence, time, time, as_bytes(pose)})) return written;
    written.push_back({"rt/ann/fusion/pose", sequence, time, pose});
  }
  return written;
}

}  // namespace vpdr::mcap::testing
