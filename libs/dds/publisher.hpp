#pragma once
// The sending end of a topic.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "dds/participant.hpp"
#include "dds/topics.hpp"
#include "dds/types.hpp"

namespace vpdr::dds {

namespace detail {
class WriterEnd;
}

struct PublisherOptions {
  /// true: publish() waits until there is room rather than push out a sample that a matched reader
  /// has not got yet. For playback faster than life; a board's samples do not wait.
  bool lossless = false;
  /// How long publish() waits then before it gives up and returns false.
  std::chrono::milliseconds patience{10'000};
};

/// A writer of one type. Thread-safe. publish() itself allocates nothing; Fast DDS 2.9.1 takes ten
/// small pieces of memory for each sample.
class AnyPublisher {
 public:
  ~AnyPublisher();
  AnyPublisher(AnyPublisher&&) noexcept;
  AnyPublisher& operator=(AnyPublisher&&) noexcept;

  /// Readers matched now.
  [[nodiscard]] std::size_t matched_count() const;

  /// Waits until that many readers are matched; false: not within the time.
  bool wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const;

  /// Waits until no reader is matched; false: not within the time.
  bool wait_for_unmatched(std::chrono::milliseconds timeout) const;

  /// Waits until every matched reliable reader has taken every sample: with Subscription at the
  /// other end, until its callback has returned for each. False: not within the time.
  bool wait_for_acknowledgments(std::chrono::milliseconds timeout);

  /// Samples sent.
  [[nodiscard]] std::uint64_t published() const;
  /// Samples that publish() could not send.
  [[nodiscard]] std::uint64_t refused() const;

 protected:
  AnyPublisher(const Participant& participant, const TopicInfo& topic, const MessageType& type,
               const PublisherOptions& options);
  AnyPublisher(const Participant& participant, const WriterInfo& as,
               const PublisherOptions& options);

  bool publish_message(const void* message);
  bool publish_bytes(std::span<const std::byte> bytes);

 private:
  std::unique_ptr<detail::WriterEnd> end_;
};

/// Publishes messages T on a topic.
///
///   dds::Publisher steps(participant, dds::topics::kStep);
///   steps.publish(step);
template <class T>
class Publisher : public AnyPublisher {
 public:
  /// Throws DdsFault.
  Publisher(const Participant& participant, const Topic<T>& topic,
            const PublisherOptions& options = {})
      : AnyPublisher(participant, topic.info, message_type<T>(), options) {}

  /// False: not sent (see PublisherOptions::patience; a duplicate sends nothing), and counted in
  /// refused().
  bool publish(const T& message) { return publish_message(&message); }
};

/// Sends samples that are serialised already, of any type: a recording's.
class RawPublisher : public AnyPublisher {
 public:
  /// `as`: topic, type and qualities of the writer to be. Throws DdsFault.
  RawPublisher(const Participant& participant, const WriterInfo& as,
               const PublisherOptions& options = {})
      : AnyPublisher(participant, as, options) {}

  /// CDR with its 4 bytes of encapsulation header; anything shorter is refused.
  bool publish(std::span<const std::byte> bytes) { return publish_bytes(bytes); }
};

}  // namespace vpdr::dds
