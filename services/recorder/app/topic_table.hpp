#pragma once
// The topics found so far with their counters. Thread-safe; a topic's index never changes.
#include <cstddef>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "dds/participant.hpp"
#include "dds/subscription.hpp"
#include "recorder/core/topic_statistics.hpp"

namespace vpdr::recorder {

/// What the file says of a topic.
struct TopicDescription {
  std::string name;  ///< after "rt/<walker>/": "imu/data_raw"
  dds::WriterInfo writer;
};

struct TopicRow {
  TopicDescription description;
  TopicStatistics statistics;
};

class TopicTable {
 public:
  /// The index of the new topic.
  std::size_t add(TopicDescription description);
  void received(std::size_t topic, const dds::SampleInfo& info, std::size_t bytes);
  /// `count` samples in the file from now on.
  void written(std::size_t topic, std::uint64_t count);

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] TopicDescription description(std::size_t topic) const;
  [[nodiscard]] std::vector<TopicRow> rows() const;

 private:
  mutable std::mutex mutex_;
  std::vector<TopicRow> rows_;
  std::set<std::pair<std::size_t, dds::Guid>> senders_;  ///< those a sample was received from
};

/// Sum over all topics.
TopicStatistics total(const std::vector<TopicRow>& rows);

}  // namespace vpdr::recorder
