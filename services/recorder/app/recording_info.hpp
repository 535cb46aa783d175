#pragma once
// What a recording holds: found by reading every chunk of it, so that each CRC is checked.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "mcap/reader.hpp"
#include "mcap/topic_counters.hpp"

namespace vpdr::recorder {

struct TopicInfo {
  std::string topic;  ///< "/ann/imu/data_raw"
  std::string type;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;  ///< of the messages, uncompressed
  std::optional<TimestampNs> first_ns;
  std::optional<TimestampNs> last_ns;
  std::optional<mcap::TopicCounters> counters;  ///< of the recorder; a torn file has none

  [[nodiscard]] double rate_hz() const;
};

struct RecordingInfo {
  std::filesystem::path file;
  mcap::Contents contents;
  std::vector<TopicInfo> topics;  ///< by name
  std::uint64_t uncompressed_bytes = 0;
  std::string walker;  ///< empty: not told
  /// The file is whole, but its recorder could not write to the end of the walk: the disk was full.
  bool ended_early = false;

  [[nodiscard]] double duration_s() const;
};

/// Throws FileFault for a file that cannot be read or is no recording.
RecordingInfo inspect(const std::filesystem::path& file);

std::string to_text(const RecordingInfo& info);
std::string to_json(const RecordingInfo& info);

}  // namespace vpdr::recorder
