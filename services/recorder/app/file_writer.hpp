#pragma once
// The thread that writes the recording.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mcap/writer.hpp"
#include "recorder/app/recorder_settings.hpp"
#include "recorder/app/sample_queue.hpp"
#include "recorder/app/topic_table.hpp"

namespace vpdr::recorder {

/// Takes samples from its queue and appends them to the file. After a failure (disk full) it goes
/// on taking samples and drops them, so that nobody is held up, and tells of it once.
class FileWriter {
 public:
  using OnFailure = std::function<void(const std::string&)>;

  /// Creates the file with the metadata record `walk`. Throws FileFault. `on_failure` is called
  /// from the writing thread or from finish().
  FileWriter(const RecorderSettings& settings, std::filesystem::path path, TopicTable& topics,
             const mcap::StringMap& walk, OnFailure on_failure);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// For the receiving threads.
  SampleQueue& queue() { return queue_; }
  /// Writes what is queued, the counters and the summary, and closes the file. Once.
  void finish();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t bytes_in_file() const { return bytes_in_file_; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  void write(const Batch& batch);
  void add_new_topics();
  std::uint16_t add_topic(const TopicDescription& description);
  void flush_when_due();
  void count_written();
  void check(const Status& status);
  void fail(const std::string& message);

  const std::filesystem::path path_;
  const Clock::duration flush_every_;
  TopicTable& topics_;
  OnFailure on_failure_;
  std::optional<mcap::Writer> writer_;
  std::vector<std::uint16_t> channels_;  ///< by index of the topic table
  SampleQueue queue_;
  Batch batch_;
  std::uint32_t chunks_ = 0;  ///< in the file when last looked at
  Clock::time_point last_chunk_ = Clock::now();
  std::atomic<std::uint64_t> bytes_in_file_{0};
  std::atomic<bool> failed_{false};
  std::jthread thread_;
};

}  // namespace vpdr::recorder
