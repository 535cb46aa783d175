#pragma once
// What a vpdr recording says of itself beyond the MCAP format: two metadata records.
#include <cstdint>
#include <optional>
#include <string>

#include "mcap/records.hpp"

namespace vpdr::mcap {

/// Name of the record about walker, host and settings, written at the start.
inline constexpr const char* kWalkRecord = "vpdr.walk";
/// Name of the record with the counters of every topic, written at the end: a torn file has none.
inline constexpr const char* kCountersRecord = "vpdr.recorder.counters";

/// What the recorder counted of one topic.
struct TopicCounters {
  std::uint64_t received = 0;  ///< samples that reached the recorder
  std::uint64_t lost = 0;      ///< samples missing between those that did
  std::uint64_t before = 0;    ///< samples sent before the recorder was there
  std::uint64_t written = 0;   ///< samples that are in the file
};

/// As text pairs: "imu/data_raw.lost" -> "0".
void add_counters(const std::string& topic, const TopicCounters& counters, StringMap& entries);

/// The inverse; nothing where the topic's pairs are not all there or not numbers.
std::optional<TopicCounters> find_counters(const std::string& topic, const StringMap& entries);

}  // namespace vpdr::mcap
