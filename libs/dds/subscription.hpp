#pragma once
// The receiving end of a topic.
//
// The callback runs in the middleware's receive thread, one sample after the other in the order of
// sending. One thread serves all subscriptions of a participant, so a slow callback holds up the
// others. It must not make or destroy endpoints. A sample is acknowledged to its writer only after
// the callback has returned, so that a writer that waits for room, or for acknowledgments, waits
// for the work and not for the arrival.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "dds/participant.hpp"
#include "dds/topics.hpp"
#include "dds/types.hpp"

namespace vpdr::dds {

namespace detail {
class ReaderEnd;
}

/// What came with a sample.
struct SampleInfo {
  std::int64_t source_timestamp_ns = 0;  ///< since 1970, writer's clock, when it was sent
  /// Since 1970, this host's clock, when it was handed over. A sample that waited for a lost one
  /// before it comes later than that, not when its datagram came.
  std::int64_t reception_timestamp_ns = 0;
  std::uint64_t sequence_number = 0;  ///< of its writer, 1 for the first
  std::uint64_t lost_before = 0;      ///< samples missing between the one before and this one
  Guid writer{};
};

/// Counters since the start.
struct ReaderCounts {
  std::uint64_t received = 0;         ///< samples whose callback has returned
  std::uint64_t lost = 0;             ///< missing in the writers' sequence numbers
  std::uint64_t reported_lost = 0;    ///< lost or pushed out by the middleware's own count
  std::uint64_t unreadable = 0;       ///< bytes that do not fit the type; not handed on
  std::uint64_t deadline_missed = 0;  ///< silences longer than the topic's deadline
  std::uint64_t liveliness_lost = 0;  ///< writers that fell silent as a whole: killed, cut off
};

/// A reader of one topic. Thread-safe.
class AnySubscription {
 public:
  ~AnySubscription();
  AnySubscription(AnySubscription&&) noexcept;
  AnySubscription& operator=(AnySubscription&&) noexcept;

  [[nodiscard]] ReaderCounts counts() const;

  /// Writers matched now.
  [[nodiscard]] std::size_t matched_count() const;

  /// Waits until that many writers are matched; false: not within the time.
  bool wait_for_matched(std::size_t count, std::chrono::milliseconds timeout) const;

  /// Waits until no writer is matched; false: not within the time.
  bool wait_for_unmatched(std::chrono::milliseconds timeout) const;

  /// Waits until the counters satisfy `condition`; false: not within the time.
  bool wait_for(const std::function<bool(const ReaderCounts&)>& condition,
                std::chrono::milliseconds timeout) const;

  /// Writers matched and alive now.
  [[nodiscard]] std::size_t alive_count() const;

 protected:
  using MessageCallback = std::function<void(const SampleInfo&)>;
  using BytesCallback = std::function<void(std::span<const std::byte>, const SampleInfo&)>;

  AnySubscription(const Participant& participant, const TopicInfo& topic, const MessageType& type,
                  const std::shared_ptr<void>& message, MessageCallback callback);
  AnySubscription(const Participant& participant, const WriterInfo& writer, BytesCallback callback);

 private:
  std::unique_ptr<detail::ReaderEnd> end_;
};

/// Receives messages T of a topic. The message is used again for the next sample: its strings and
/// sequences keep their memory, so that nothing is allocated here once the largest was seen.
///
///   dds::Subscription steps(participant, dds::topics::kStep,
///                           [&](const vpdr_msgs::msg::Step& step, const dds::SampleInfo&) {...});
template <class T>
class Subscription : public AnySubscription {
 public:
  using Callback = std::function<void(const T&, const SampleInfo&)>;

  /// Throws DdsFault.
  Subscription(const Participant& participant, const Topic<T>& topic,
               std::type_identity_t<Callback> callback)
      : Subscription(participant, topic, std::make_shared<T>(), std::move(callback)) {}

 private:
  Subscription(const Participant& participant, const Topic<T>& topic, std::shared_ptr<T> message,
               Callback callback)
      : AnySubscription(participant, topic.info, message_type<T>(), message,
                        [message, callback = std::move(callback)](const SampleInfo& info) {
                          callback(*message, info);
                        }) {}
};

/// Receives the samples of a topic as they are on the wire, of any type, known or not: CDR with its
/// 4 bytes of encapsulation header, and zeros up to a multiple of 4 bytes. Asks for no more than
/// `writer` offers.
class RawSubscription : public AnySubscription {
 public:
  using Callback = BytesCallback;

  /// `writer`: as discovery tells of it; only topic, type and qualities matter. Throws DdsFault.
  RawSubscription(const Participant& participant, const WriterInfo& writer, Callback callback)
      : AnySubscription(participant, writer, std::move(callback)) {}
};

}  // namespace vpdr::dds
