#pragma once
// From a topic's quality of service to that of Fast DDS.
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>

#include "dds/participant.hpp"
#include "dds/topics.hpp"

namespace vpdr::dds::detail {

namespace fast = eprosima::fastdds::dds;

/// "vpdr/<walker>/<service>", the participant's name.
std::string own_name(const ParticipantOptions& options);

/// `addresses`: of the interfaces to use, empty for all.
fast::DomainParticipantQos participant_qos(const ParticipantOptions& options,
                                           const std::vector<std::string>& addresses,
                                           const std::string& user_data);

/// `lossless`: publish() waits for lagging readers, for `patience_s` at most, rather than drop.
fast::DataWriterQos writer_qos(const Qos& qos, bool lossless, double patience_s);

/// Asks of writers what the topic promises.
fast::DataReaderQos reader_qos(const Qos& qos);

/// Asks for nothing but the reliability and durability in `qos`: for writers of any make.
fast::DataReaderQos undemanding_reader_qos(const Qos& qos);

/// "reliability", "deadline", ... of a DDS policy id.
std::string policy_name(std::uint32_t policy_id);

}  // namespace vpdr::dds::detail
