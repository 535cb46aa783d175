#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "dds/participant.hpp"

namespace vpdr::dds::test {

inline constexpr std::chrono::milliseconds kPatience{20'000};

/// A participant that is heard on this host only.
inline ParticipantOptions loopback(std::uint32_t domain, const std::string& service) {
  ParticipantOptions options;
  options.walker = "tester";
  options.service = service;
  options.domain = domain;
  options.interfaces = {"127.0.0.1"};
  return options;
}

/// What a callback has seen so far, and a way to wait for more.
template <class T>
class Collected {
 public:
  void add(T item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(std::move(item));
    changed_.notify_all();
  }

  [[nodiscard]] bool wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return items_.size() >= count; });
  }

  [[nodiscard]] std::vector<T> items() const {
    const std::lock_guard lock(mutex_);
    return items_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> items_;
};

}  // namespace vpdr::dds::test
