#pragma once
// A Fast DDS participant with what it has seen of the others. Endpoints hold it, so that it
// outlives them. Thread-safe.
#include <atomic>
#include <condition_variable>
#include <deque>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <map>
#include <mutex>

#include "dds/detail/peers.hpp"
#include "dds/detail/qos.hpp"
#include "dds/participant.hpp"

namespace vpdr::dds::detail {

Guid to_guid(const eprosima::fastrtps::rtps::GUID_t& guid);

class ParticipantState final : public fast::DomainParticipantListener {
 public:
  /// Throws DdsFault.
  explicit ParticipantState(const ParticipantOptions& options);
  ~ParticipantState() override;
  ParticipantState(const ParticipantState&) = delete;
  ParticipantState& operator=(const ParticipantState&) = delete;

  [[nodiscard]] const ParticipantOptions& options() const { return options_; }
  [[nodiscard]] Guid guid() const { return to_guid(participant_->guid()); }
  [[nodiscard]] fast::Publisher& publisher() const { return *publisher_; }
  [[nodiscard]] fast::Subscriber& subscriber() const { return *subscriber_; }

  /// The DDS topic of that path and ROS type, made at its first use. Throws DdsFault where this
  /// participant uses the path with another type.
  fast::Topic& topic(const std::string& path, const std::string& ros_type);

  void report(const Problem& problem);

  std::vector<Problem> take_problems();
  [[nodiscard]] bool is_duplicate() const { return duplicate_; }
  bool wait_for_duplicate(std::chrono::milliseconds timeout) const;
  [[nodiscard]] std::vector<RemoteParticipant> remote_participants() const;
  bool wait_for_service(const std::string& service, std::chrono::milliseconds timeout) const;
  bool wait_for_participants(std::size_t count, std::chrono::milliseconds timeout) const;
  [[nodiscard]] std::vector<WriterInfo> writers() const;
  std::vector<WriterEvent> take_writer_events(std::chrono::milliseconds timeout);

 private:
  using Prefix = std::array<std::uint8_t, 12>;

  void on_participant_discovery(fast::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void on_publisher_discovery(fast::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(fast::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;

  void participant_appeared(const Guid& own_guid, RemoteParticipant peer);
  void participant_gone(const Guid& guid);
  void check_identity(const Guid& own_guid, const RemoteParticipant& peer);
  void check_type(const std::string& topic, const std::string& ros_type, const Guid& endpoint);
  void writer_appeared(WriterInfo writer);
  void writer_gone(const Guid& guid);
  void push_event(bool appeared, WriterInfo writer);  // under mutex_

  ParticipantOptions options_;
  Identity identity_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::atomic<bool> duplicate_ = false;  // set under mutex_, read for every sample
  std::deque<Problem> problems_;
  std::map<Guid, RemoteParticipant> peers_;
  std::map<Guid, WriterInfo> writers_;
  bool events_wanted_ = false;  // from the first take_writer_events() on
  std::deque<WriterEvent> events_;
  std::map<std::string, std::string> own_types_;  // topic path to ROS type

  std::mutex topics_mutex_;
  std::map<std::string, fast::Topic*> topics_;
};

}  // namespace vpdr::dds::detail
