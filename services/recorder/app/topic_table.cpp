#include "recorder/app/topic_table.hpp"

#include <utility>

namespace vpdr::recorder {

std::size_t TopicTable::add(TopicDescription description) {
  const std::lock_guard lock(mutex_);
  rows_.push_back({std::move(description), {}});
  return rows_.size() - 1;
}

void TopicTable::received(std::size_t topic, const dds::SampleInfo& info, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  TopicStatistics& statistics = rows_[topic].statistics;
  const bool first = senders_.emplace(topic, info.writer).second;
  if (first && info.sequence_number > 1) statistics.before += info.sequence_number - 1;
  statistics.take(info.reception_timestamp_ns, bytes, info.lost_before);
}

void TopicTable::written(std::size_t topic, std::uint64_t count) {
  const std::lock_guard lock(mutex_);
  rows_[topic].statistics.written = count;
}

std::size_t TopicTable::size() const {
  const std::lock_guard lock(mutex_);
  return rows_.size();
}

TopicDescription TopicTable::description(std::size_t topic) const {
  const std::lock_guard lock(mutex_);
  return rows_[topic].description;
}

std::vector<TopicRow> TopicTable::rows() const {
  const std::lock_guard lock(mutex_);
  return rows_;
}

TopicStatistics total(const std::vector<TopicRow>& rows) {
  TopicStatistics sum;
  for (const TopicRow& row : rows) sum += row.statistics;
  return sum;
}

}  // namespace vpdr::recorder
