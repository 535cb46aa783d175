#pragma once
// Samples on their way from the middleware's receive thread to the thread that writes the file.
//
// Bounded: when it is full, push() waits, so that the middleware does not acknowledge what it
// cannot hand on and the senders keep it in their histories. Nothing is dropped here. The two
// buffers change places, so that nothing is allocated once they have grown. Thread-safe.
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "core/time.hpp"

namespace vpdr::recorder {

struct QueuedSample {
  std::size_t topic = 0;  ///< index in the topic table
  std::uint32_t sequence = 0;
  TimestampNs log_time_ns = 0;
  TimestampNs publish_time_ns = 0;
  std::size_t offset = 0;  ///< of its payload in Batch::bytes; set by the queue
  std::size_t size = 0;
};

struct Batch {
  std::vector<QueuedSample> samples;
  std::vector<std::byte> bytes;

  [[nodiscard]] std::span<const std::byte> payload_of(const QueuedSample& sample) const {
    return std::span(bytes).subspan(sample.offset, sample.size);
  }
  void clear() {
    samples.clear();
    bytes.clear();
  }
};

class SampleQueue {
 public:
  explicit SampleQueue(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Waits for room; false once closed. A sample larger than the queue waits until it is empty.
  bool push(QueuedSample sample, std::span<const std::byte> payload);
  /// Swaps what has come with `batch`, after clearing that. Waits `timeout` for something; an empty
  /// batch is given when nothing came. False: closed and empty.
  bool take(Batch& batch, std::chrono::milliseconds timeout);
  void close();

  /// How often push() had to wait.
  [[nodiscard]] std::uint64_t waits() const;

 private:
  [[nodiscard]] bool has_room(std::size_t size) const {
    return filling_.bytes.empty() || filling_.bytes.size() + size <= max_bytes_;
  }

  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Batch filling_;
  std::uint64_t waits_ = 0;
  bool closed_ = false;
};

}  // namespace vpdr::recorder
