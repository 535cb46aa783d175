#pragma once
#include <condition_variable>
#include <cstddef>
#include <mutex>

#include "tests/unit/dds/loopback.hpp"

namespace vpdr::dds::test {

/// Holds up those that pass while it is closed, and counts them.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++arrivals_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
    ++departures_;
  }

  void open() { set(true); }
  void close() { set(false); }

  bool wait_for_arrivals(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return arrivals_ >= count; });
  }

  std::size_t departures() {
    const std::lock_guard lock(mutex_);
    return departures_;
  }

 private:
  void set(bool open) {
    const std::lock_guard lock(mutex_);
    open_ = open;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
  std::size_t arrivals_ = 0;
  std::size_t departures_ = 0;
};

}  // namespace vpdr::dds::test
