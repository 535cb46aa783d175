#include "dds/detail/qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <cmath>

namespace vpdr::dds::detail {
namespace {

using eprosima::fastrtps::Duration_t;

constexpr std::uint32_t kSocketBufferBytes = 4U << 20U;
constexpr double kLivelinessLease_s = 2.0;
constexpr double kLivelinessAnnouncement_s = 0.5;
// Samples that wait for a lost one before them; taken at once otherwise.
constexpr int kReaderSamples = 5000;
constexpr int kAllocatedSamples = 32;
// Participants of one host that a unicast peer address reaches.
constexpr std::uint32_t kParticipantsPerPeer = 32;

Duration_t duration(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>((seconds - whole) * 1e9)};
}

void add_peers(const std::vector<std::string>& peers, fast::DomainParticipantQos& qos) {
  if (peers.empty()) return;
  namespace rtps = eprosima::fastrtps::rtps;
  auto& list = qos.wire_protocol().builtin.initialPeersList;
  for (const auto& peer : peers) {
    rtps::Locator_t locator;
    locator.kind = LOCATOR_KIND_UDPv4;
    rtps::IPLocator::setIPv4(locator, peer);
    locator.port = 0;  // the ports of the domain's first participants
    list.push_back(locator);
  }
  // A list of one's own replaces the multicast group; it stays in use beside the peers.
  rtps::Locator_t multicast;
  multicast.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(multicast, 239, 255, 0, 1);
  multicast.port = 0;
  list.push_back(multicast);
}

template <class EndpointQos>
void set_common(const Qos& qos, EndpointQos& endpoint) {
  endpoint.reliability().kind =
      qos.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  endpoint.durability().kind =
      qos.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  endpoint.data_sharing().off();
  // Payloads grow to what is sent and are used again: no allocation once the largest was seen.
  endpoint.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

void set_limits(int samples, fast::ResourceLimitsQosPolicy& limits) {
  limits.max_samples = samples;
  limits.max_instances = 1;
  limits.max_samples_per_instance = samples;
  limits.allocated_samples = std::min(samples, kAllocatedSamples);
}

}  // namespace

std::string own_name(const ParticipantOptions& options) {
  return "vpdr/" + options.walker + "/" + options.service;
}

fast::DomainParticipantQos participant_qos(const ParticipantOptions& options,
                                           const std::vector<std::string>& addresses,
                                           const std::string& user_data) {
  fast::DomainParticipantQos qos;
  qos.name(own_name(options));
  qos.user_data().data_vec({user_data.begin(), user_data.end()});

  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = addresses;
  udp->sendBufferSize = kSocketBufferBytes;  // the kernel gives as much of it as it allows
  udp->receiveBufferSize = kSocketBufferBytes;
  udp->maxInitialPeersRange = kParticipantsPerPeer;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(std::move(udp));

  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = duration(options.lease_s);
  discovery.leaseDuration_announcementperiod = duration(options.announcement_s);
  add_peers(options.peers, qos);
  return qos;
}

fast::DataWriterQos writer_qos(const Qos& qos, bool lossless, double patience_s) {
  fast::DataWriterQos writer;
  set_common(qos, writer);
  writer.history().kind = lossless ? fast::KEEP_ALL_HISTORY_QOS : fast::KEEP_LAST_HISTORY_QOS;
  writer.history().depth = qos.depth;
  set_limits(qos.depth, writer.resource_limits());
  writer.reliability().max_blocking_time = duration(patience_s);
  writer.liveliness().kind = fast::AUTOMATIC_LIVELINESS_QOS;
  writer.liveliness().lease_duration = duration(kLivelinessLease_s);
  writer.liveliness().announcement_period = duration(kLivelinessAnnouncement_s);
  auto& times = writer.reliable_writer_qos().times;
  // The default is 3 s: that long would a reader wait for a lost last sample.
  times.heartbeatPeriod = duration(qos.heartbeat_s);
  // A timer that each sample starts unless it runs, and that wakes a thread twice: with the default
  // of zero it would run out for every one. A sample asked for again before it has run out waits
  // for the next heartbeat.
  times.nackSupressionDuration = duration(qos.heartbeat_s);
  writer.publish_mode().kind =
      qos.large ? fast::ASYNCHRONOUS_PUBLISH_MODE : fast::SYNCHRONOUS_PUBLISH_MODE;
  return writer;
}

fast::DataReaderQos undemanding_reader_qos(const Qos& qos) {
  fast::DataReaderQos reader;
  set_common(qos, reader);
  // Every sample is taken as it comes; what the history holds are samples ahead of a lost one, and
  // none of those may push another out.
  reader.history().kind = qos.reliable ? fast::KEEP_ALL_HISTORY_QOS : fast::KEEP_LAST_HISTORY_QOS;
  reader.history().depth = qos.depth;
  set_limits(qos.reliable ? std::max(qos.depth, kReaderSamples) : qos.depth,
             reader.resource_limits());
  return reader;
}

fast::DataReaderQos reader_qos(const Qos& qos) {
  auto reader = undemanding_reader_qos(qos);
  reader.liveliness().kind = fast::AUTOMATIC_LIVELINESS_QOS;
  reader.liveliness().lease_duration = duration(kLivelinessLease_s);
  return reader;
}

std::string policy_name(std::uint32_t policy_id) {
  switch (policy_id) {
    case fast::DURABILITY_QOS_POLICY_ID:
      return "durability";
    case fast::DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case fast::OWNERSHIP_QOS_POLICY_ID:
      return "ownership";
    case fast::LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case fast::RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case fast::DATAREPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    default:
      return "policy " + std::to_string(policy_id);
  }
}

}  // namespace vpdr::dds::detail
