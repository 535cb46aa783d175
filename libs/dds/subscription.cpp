#include "dds/subscription.hpp"

#include <algorithm>
#include <condition_variable>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <mutex>
#include <vector>

#include "core/errors.hpp"
#include "core/host_clock.hpp"
#include "dds/detail/deadline_watch.hpp"
#include "dds/detail/envelope.hpp"
#include "dds/detail/participant_state.hpp"
#include "dds/detail/sequence.hpp"

namespace vpdr::dds {
namespace detail {

constexpr int kRawDepth = 5000;

class ReaderEnd final : public fast::DataReaderListener {
 public:
  using Handler = std::function<void(const SampleInfo&)>;

  ReaderEnd(std::shared_ptr<ParticipantState> participant, std::string path,
            const std::string& ros_type, const fast::DataReaderQos& qos, double deadline_s,
            Envelope envelope, Handler handler)
      : participant_(std::move(participant)),
        path_(std::move(path)),
        envelope_(envelope),
        handler_(std::move(handler)),
        deadline_(deadline_s) {
    auto& topic = participant_->topic(path_, ros_type);
    reader_ = participant_->subscriber().create_datareader(&topic, qos, this);
    if (reader_ == nullptr) throw DdsFault("no DDS reader on topic " + path_);
  }

  ~ReaderEnd() override {
    reader_->set_listener(nullptr);
    participant_->subscriber().delete_datareader(reader_);
  }

  ReaderEnd(const ReaderEnd&) = delete;
  ReaderEnd& operator=(const ReaderEnd&) = delete;

  ReaderCounts counts() const {
    const std::lock_guard lock(mutex_);
    return counts_now();
  }

  std::size_t matched_count() const {
    const std::lock_guard lock(mutex_);
    return matched_;
  }

  std::size_t alive_count() const {
    const std::lock_guard lock(mutex_);
    return alive_;
  }

  bool wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return matched_ >= count; });
  }

  bool wait_for_unmatched(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return matched_ == 0; });
  }

  bool wait_for(const std::function<bool(const ReaderCounts&)>& condition,
                std::chrono::milliseconds timeout) const {
    const auto end = Clock::now() + timeout;
    std::unique_lock lock(mutex_);
    while (!condition(counts_now())) {
      const auto now = Clock::now();
      if (now >= end) return false;
      changed_.wait_until(lock, std::min(end, deadline_.next(now).value_or(end)));
    }
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;

  ReaderCounts counts_now() const {
    ReaderCounts counts = counts_;
    counts.deadline_missed = deadline_.missed(Clock::now());
    return counts;
  }

  void on_data_available(fast::DataReader* reader) override {
    fast::SampleInfo fast_info;
    envelope_.readable = true;
    while (reader->take_next_sample(&envelope_, &fast_info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (fast_info.valid_data) take(fast_info);
      envelope_.readable = true;
    }
  }

  void take(const fast::SampleInfo& fast_info) {
    SampleInfo info;
    info.source_timestamp_ns = fast_info.source_timestamp.to_ns();
    info.reception_timestamp_ns = host_now_ns();
    info.sequence_number = fast_info.sample_identity.sequence_number().to64long();
    info.writer = to_guid(fast_info.sample_identity.writer_guid());
    {
      const std::lock_guard lock(mutex_);
      info.lost_before = sequences_.gap_before(info.writer, info.sequence_number);
      counts_.lost += info.lost_before;
      deadline_.see(Clock::now());
    }
    if (envelope_.readable) handler_(info);
    const std::lock_guard lock(mutex_);
    ++(envelope_.readable ? counts_.received : counts_.unreadable);
    changed_.notify_all();
  }

  void on_subscription_matched(fast::DataReader*,
                               const fast::SubscriptionMatchedStatus& status) override {
    const std::lock_guard lock(mutex_);
    matched_ = static_cast<std::size_t>(status.current_count);
    changed_.notify_all();
  }

  void on_liveliness_changed(fast::DataReader*,
                             const fast::LivelinessChangedStatus& status) override {
    const std::lock_guard lock(mutex_);
    alive_ = static_cast<std::size_t>(std::max(0, status.alive_count));
    if (status.not_alive_count_change > 0) {
      counts_.liveliness_lost += static_cast<std::uint64_t>(status.not_alive_count_change);
    }
    changed_.notify_all();
  }

  void on_sample_lost(fast::DataReader*, const fast::SampleLostStatus& status) override {
    const std::lock_guard lock(mutex_);
    counts_.reported_lost = static_cast<std::uint64_t>(status.total_count);
    changed_.notify_all();
  }

  void on_requested_incompatible_qos(fast::DataReader*,
                                     const fast::RequestedIncompatibleQosStatus& status) override {
    participant_->report(
        {ProblemKind::kIncompatibleQos, path_,
         "topic " + path_ + ": a writer offers less " + policy_name(status.last_policy_id) +
             " than is asked for, and is not heard: start it with vpdr's settings for this topic"});
  }

  std::shared_ptr<ParticipantState> participant_;
  std::string path_;
  Envelope envelope_;  // used by the receive thread only
  Handler handler_;
  fast::DataReader* reader_ = nullptr;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  SequenceGaps sequences_;
  ReaderCounts counts_;
  DeadlineWatch deadline_;
  std::size_t matched_ = 0;
  std::size_t alive_ = 0;
};

}  // namespace detail

AnySubscription::AnySubscription(const Participant& participant, const TopicInfo& topic,
                                 const MessageType& type, const std::shared_ptr<void>& message,
                                 MessageCallback callback)
    : end_(std::make_unique<detail::ReaderEnd>(
          participant.state(), topic_path(participant.options().walker, topic.name),
          std::string(type.name), detail::reader_qos(topic.qos), topic.qos.deadline_s,
          detail::Envelope{.type = &type, .target = message.get()}, std::move(callback))) {}

AnySubscription::AnySubscription(const Participant& participant, const WriterInfo& writer,
                                 BytesCallback callback) {
  const Qos qos{.reliable = writer.reliable,
                .transient_local = writer.transient_local,
                .depth = detail::kRawDepth};
  auto bytes = std::make_shared<std::vector<std::byte>>();
  end_ = std::make_unique<detail::ReaderEnd>(
      participant.state(), writer.topic, writer.type, detail::undemanding_reader_qos(qos), 0.0,
      detail::Envelope{.raw = bytes.get()},
      [bytes, callback = std::move(callback)](const SampleInfo& info) { callback(*bytes, info); });
}

AnySubscription::~AnySubscription() = default;
AnySubscription::AnySubscription(AnySubscription&&) noexcept = default;
AnySubscription& AnySubscription::operator=(AnySubscription&&) noexcept = default;

ReaderCounts AnySubscription::counts() const { return end_->counts(); }
std::size_t AnySubscription::matched_count() const { return end_->matched_count(); }
std::size_t AnySubscription::alive_count() const { return end_->alive_count(); }

bool AnySubscription::wait_for_unmatched(std::chrono::milliseconds timeout) const {
  return end_->wait_for_unmatched(timeout);
}

bool AnySubscription::wait_for(const std::function<bool(const ReaderCounts&)>& condition,
                               std::chrono::milliseconds timeout) const {
  return end_->wait_for(condition, timeout);
}

bool AnySubscription::wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const {
  return end_->wait_for_matched(count, timeout);
}

}  // namespace vpdr::dds
