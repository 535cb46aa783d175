#include "recorder/app/sample_queue.hpp"

#include <utility>

namespace vpdr::recorder {

bool SampleQueue::push(QueuedSample sample, std::span<const std::byte> payload) {
  {
    std::unique_lock lock(mutex_);
    if (!closed_ && !has_room(payload.size())) {
      ++waits_;
      changed_.wait(lock, [&] { return closed_ || has_room(payload.size()); });
    }
    if (closed_) return false;
    sample.offset = filling_.bytes.size();
    sample.size = payload.size();
    filling_.bytes.insert(filling_.bytes.end(), payload.begin(), payload.end());
    filling_.samples.push_back(sample);
  }
  changed_.notify_all();
  return true;
}

bool SampleQueue::take(Batch& batch, std::chrono::milliseconds timeout) {
  batch.clear();
  {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return closed_ || !filling_.samples.empty(); });
    std::swap(batch, filling_);
    if (batch.samples.empty()) return !closed_;
  }
  changed_.notify_all();
  return true;
}

void SampleQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

std::uint64_t SampleQueue::waits() const {
  const std::lock_guard lock(mutex_);
  return waits_;
}

}  // namespace vpdr::recorder
