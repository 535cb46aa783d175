// What a participant learns of the others, and what it makes of it.
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <utility>

#include "dds/detail/participant_state.hpp"
#include "dds/types.hpp"

namespace vpdr::dds::detail {
namespace {

namespace rtps = eprosima::fastrtps::rtps;

Guid participant_of(Guid endpoint) {
  constexpr std::array<std::uint8_t, 4> kParticipantEntity{0, 0, 1, 0xc1};
  std::copy(kParticipantEntity.begin(), kParticipantEntity.end(), endpoint.begin() + 12);
  return endpoint;
}

RemoteParticipant describe(const rtps::ParticipantProxyData& data) {
  RemoteParticipant peer;
  peer.guid = to_guid(data.m_guid);
  peer.name = data.m_participantName.to_string();
  const auto& bytes = data.m_userData.data_vec();
  if (auto identity =
          parse_user_data({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
    peer.walker = std::move(identity->walker);
    peer.service = std::move(identity->service);
    peer.idl_hash = std::move(identity->idl_hash);
    peer.start_ns = identity->start_ns;
  }
  return peer;
}

}  // namespace

void ParticipantState::on_participant_discovery(fast::DomainParticipant* self,
                                                rtps::ParticipantDiscoveryInfo&& info) {
  switch (info.status) {
    case rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT:
    case rtps::ParticipantDiscoveryInfo::CHANGED_QOS_PARTICIPANT:
      return participant_appeared(to_guid(self->guid()), describe(info.info));
    case rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT:
    case rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT:
      return participant_gone(to_guid(info.info.m_guid));
  }
}

void ParticipantState::participant_appeared(const Guid& own_guid, RemoteParticipant peer) {
  check_identity(own_guid, peer);
  const std::lock_guard lock(mutex_);
  peers_.insert_or_assign(peer.guid, std::move(peer));
  changed_.notify_all();
}

void ParticipantState::participant_gone(const Guid& guid) {
  const std::lock_guard lock(mutex_);
  peers_.erase(guid);
  std::vector<Guid> orphans;
  for (const auto& [writer_guid, writer] : writers_) {
    if (participant_of(writer_guid) == guid) orphans.push_back(writer_guid);
  }
  for (const auto& orphan : orphans) push_event(false, writers_.extract(orphan).mapped());
  changed_.notify_all();
}

void ParticipantState::check_identity(const Guid& own_guid, const RemoteParticipant& peer) {
  if (peer.idl_hash.empty()) return;  // another vendor's, or a tool
  if (peer.idl_hash != identity_.idl_hash) {
    report({ProblemKind::kIdlMismatch, "",
            "participant " + peer.name + " was built from message definitions " + peer.idl_hash +
                ", this one from " + identity_.idl_hash +
                ": their samples cannot be trusted; install the same version of vpdr on both"});
  }
  if (peer.walker != identity_.walker || peer.service != identity_.service) return;
  const bool peer_was_first =
      std::pair(peer.start_ns, peer.guid) < std::pair(identity_.start_ns, own_guid);
  if (!peer_was_first) return;
  {
    const std::lock_guard lock(mutex_);
    duplicate_ = true;
    changed_.notify_all();
  }
  report({ProblemKind::kDuplicateInstance, "",
          "service '" + peer.service + "' runs already for walker '" + peer.walker +
              "' in DDS domain " + std::to_string(options_.domain) +
              ": stop the other one, or give this one another --walker or --domain"});
}

void ParticipantState::check_type(const std::string& topic, const std::string& ros_type,
                                  const Guid& endpoint) {
  std::string own_type;
  std::string peer = "unknown";
  {
    const std::lock_guard lock(mutex_);
    const auto own = own_types_.find(topic);
    if (own == own_types_.end() || own->second == ros_type) return;
    own_type = own->second;
    if (const auto at = peers_.find(participant_of(endpoint)); at != peers_.end()) {
      peer = at->second.name;
    }
  }
  report({ProblemKind::kTypeMismatch, topic,
          "topic " + topic + ": participant " + peer + " uses it as " + ros_type +
              ", this one as " + own_type +
              "; nothing crosses it: give one of them another topic"});
}

void ParticipantState::on_publisher_discovery(fast::DomainParticipant* self,
                                              rtps::WriterDiscoveryInfo&& info) {
  const Guid guid = to_guid(info.info.guid());
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) return writer_gone(guid);
  if (info.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
  WriterInfo writer;
  writer.guid = guid;
  writer.topic = info.info.topicName().to_string();
  writer.type = ros_type_name(info.info.typeName().to_string());
  writer.reliable = info.info.m_qos.m_reliability.kind == fast::RELIABLE_RELIABILITY_QOS;
  writer.transient_local =
      info.info.m_qos.m_durability.kind >= fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  if (participant_of(guid) == to_guid(self->guid())) writer.participant = own_name(options_);
  check_type(writer.topic, writer.type, guid);
  writer_appeared(std::move(writer));
}

void ParticipantState::on_subscriber_discovery(fast::DomainParticipant*,
                                               rtps::ReaderDiscoveryInfo&& info) {
  if (info.status != rtps::ReaderDiscoveryInfo::DISCOVERED_READER) return;
  check_type(info.info.topicName().to_string(), ros_type_name(info.info.typeName().to_string()),
             to_guid(info.info.guid()));
}

void ParticipantState::writer_appeared(WriterInfo writer) {
  const std::lock_guard lock(mutex_);
  if (const auto at = peers_.find(participant_of(writer.guid)); at != peers_.end()) {
    writer.participant = at->second.name;
  }
  if (!writers_.emplace(writer.guid, writer).second) return;
  push_event(true, std::move(writer));
}

void ParticipantState::writer_gone(const Guid& guid) {
  const std::lock_guard lock(mutex_);
  const auto at = writers_.find(guid);
  if (at == writers_.end()) return;
  push_event(false, writers_.extract(at).mapped());
}

void ParticipantState::push_event(bool appeared, WriterInfo writer) {
  if (!events_wanted_) return;
  events_.push_back({appeared, std::move(writer)});
  changed_.notify_all();
}

}  // namespace vpdr::dds::detail
