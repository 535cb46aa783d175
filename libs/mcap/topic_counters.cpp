#include "mcap/topic_counters.hpp"

#include <array>
#include <charconv>
#include <utility>

namespace vpdr::mcap {
namespace {

using Field = std::uint64_t TopicCounters::*;
constexpr std::array<std::pair<const char*, Field>, 4> kFields{
    {{".received", &TopicCounters::received},
     {".lost", &TopicCounters::lost},
     {".before", &TopicCounters::before},
     {".written", &TopicCounters::written}}};

bool parse(const std::string& text, std::uint64_t& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

}  // namespace

void add_counters(const std::string& topic, const TopicCounters& counters, StringMap& entries) {
  for (const auto& [name, field] : kFields) {
    entries[topic + name] = std::to_string(counters.*field);
  }
}

std::optional<TopicCounters> find_counters(const std::string& topic, const StringMap& entries) {
  TopicCounters counters;
  for (const auto& [name, field] : kFields) {
    const auto found = entries.find(topic + name);
    if (found == entries.end() || !parse(found->second, counters.*field)) return std::nullopt;
  }
  return counters;
}

}  // namespace vpdr::mcap
