#include "dds/publisher.hpp"

#include <atomic>
#include <condition_variable>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <mutex>

#include "core/errors.hpp"
#include "dds/detail/envelope.hpp"
#include "dds/detail/participant_state.hpp"

namespace vpdr::dds {
namespace {

constexpr int kRawDepth = 1000;

}  // namespace

namespace detail {

class WriterEnd final : public fast::DataWriterListener {
 public:
  /// `type`: null for a writer of raw bytes.
  WriterEnd(std::shared_ptr<ParticipantState> participant, std::string path,
            const std::string& ros_type, const MessageType* type, const Qos& qos,
            const PublisherOptions& options)
      : participant_(std::move(participant)), path_(std::move(path)), type_(type) {
    auto& topic = participant_->topic(path_, ros_type);
    writer_ = participant_->publisher().create_datawriter(
        &topic,
        writer_qos(qos, options.lossless, std::chrono::duration<double>(options.patience).count()),
        this);
    if (writer_ == nullptr) throw DdsFault("no DDS writer on topic " + path_);
  }

  ~WriterEnd() override {
    writer_->set_listener(nullptr);
    participant_->publisher().delete_datawriter(writer_);
  }

  WriterEnd(const WriterEnd&) = delete;
  WriterEnd& operator=(const WriterEnd&) = delete;

  bool publish(const void* message) {
    Envelope envelope;
    envelope.type = type_;
    envelope.message = message;
    return write(envelope);
  }

  bool publish(std::span<const std::byte> bytes) {
    Envelope envelope;
    envelope.bytes_to_send = bytes;
    return write(envelope);
  }

  std::size_t matched_count() const {
    const std::lock_guard lock(mutex_);
    return matched_;
  }

  bool wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return matched_ >= count; });
  }

  bool wait_for_unmatched(std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return matched_ == 0; });
  }

  bool wait_for_acknowledgments(std::chrono::milliseconds timeout) {
    const auto ms = timeout.count();
    return writer_->wait_for_acknowledgments({static_cast<std::int32_t>(ms / 1000),
                                              static_cast<std::uint32_t>(ms % 1000 * 1'000'000)}) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

  std::uint64_t published() const { return published_; }
  std::uint64_t refused() const { return refused_; }

 private:
  bool write(Envelope& envelope) {
    // A second instance must not speak into the walk of the first until it has left.
    const bool sent = !participant_->is_duplicate() && writer_->write(&envelope);
    (sent ? published_ : refused_).fetch_add(1, std::memory_order_relaxed);
    return sent;
  }

  void on_publication_matched(fast::DataWriter*,
                              const fast::PublicationMatchedStatus& status) override {
    const std::lock_guard lock(mutex_);
    matched_ = static_cast<std::size_t>(status.current_count);
    changed_.notify_all();
  }

  void on_offered_incompatible_qos(fast::DataWriter*,
                                   const fast::OfferedIncompatibleQosStatus& status) override {
    participant_->report({ProblemKind::kIncompatibleQos, path_,
                          "topic " + path_ + ": a reader asks for more " +
                              policy_name(status.last_policy_id) +
                              " than is offered, and gets nothing: start it with less, or with "
                              "vpdr's own settings"});
  }

  std::shared_ptr<ParticipantState> participant_;
  std::string path_;
  const MessageType* type_;
  fast::DataWriter* writer_ = nullptr;
  std::atomic<std::uint64_t> published_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::size_t matched_ = 0;
};

}  // namespace detail

AnyPublisher::AnyPublisher(const Participant& participant, const TopicInfo& topic,
                           const MessageType& type, const PublisherOptions& options)
    : end_(std::make_unique<detail::WriterEnd>(participant.state(),
                                               topic_path(participant.options().walker, topic.name),
                                               std::string(type.name), &type, topic.qos, options)) {
}

AnyPublisher::AnyPublisher(const Participant& participant, const WriterInfo& as,
                           const PublisherOptions& options)
    : end_(std::make_unique<detail::WriterEnd>(
          participant.state(), as.topic, as.type, nullptr,
          Qos{.reliable = as.reliable, .transient_local = as.transient_local, .depth = kRawDepth},
          options)) {}

AnyPublisher::~AnyPublisher() = default;
AnyPublisher::AnyPublisher(AnyPublisher&&) noexcept = default;
AnyPublisher& AnyPublisher::operator=(AnyPublisher&&) noexcept = default;

std::size_t AnyPublisher::matched_count() const { return end_->matched_count(); }

bool AnyPublisher::wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const {
  return end_->wait_for_matched(count, timeout);
}

bool AnyPublisher::wait_for_unmatched(std::chrono::milliseconds timeout) const {
  return end_->wait_for_unmatched(timeout);
}

bool AnyPublisher::wait_for_acknowledgments(std::chrono::milliseconds timeout) {
  return end_->wait_for_acknowledgments(timeout);
}

std::uint64_t AnyPublisher::published() const { return end_->published(); }
std::uint64_t AnyPublisher::refused() const { return end_->refused(); }

bool AnyPublisher::publish_message(const void* message) { return end_->publish(message); }

bool AnyPublisher::publish_bytes(std::span<const std::byte> bytes) { return end_->publish(bytes); }

}  // namespace vpdr::dds
