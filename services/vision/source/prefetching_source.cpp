#include "vision/source/prefetching_source.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace vpdr::vision {
namespace {

class PrefetchingSource : public FrameSource {
 public:
  PrefetchingSource(std::unique_ptr<FrameSource> source, std::size_t depth)
      : source_(std::move(source)),
        depth_(depth),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  [[nodiscard]] std::optional<TimestampNs> next_stamp() const override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !frames_.empty() || ended_; });
    if (frames_.empty()) return std::nullopt;
    return frames_.front().stamp_ns;
  }

  Frame load() override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !frames_.empty() || ended_; });
    if (frames_.empty()) return {};
    Frame frame = std::move(frames_.front());
    frames_.pop_front();
    changed_.notify_all();
    return frame;
  }

 private:
  void run(const std::stop_token& stop) {
    while (source_->next_stamp()) {
      {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, stop, [this] { return frames_.size() < depth_; })) break;
      }
      Frame frame = source_->load();
      const std::lock_guard lock(mutex_);
      frames_.push_back(std::move(frame));
      changed_.notify_all();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  std::unique_ptr<FrameSource> source_;
  std::size_t depth_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::deque<Frame> frames_;
  bool ended_ = false;
  std::jthread thread_;  // last: the first to stop
};

}  // namespace

std::unique_ptr<FrameSource> make_prefetching_source(std::unique_ptr<FrameSource> source,
                                                     std::size_t depth) {
  return std::make_unique<PrefetchingSource>(std::move(source), depth);
}

}  // namespace vpdr::vision
