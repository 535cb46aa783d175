#pragma once
// A topic's quality of service in the form in which rosbag2 keeps it in a recording.
#include <string>

#include "dds/participant.hpp"

namespace vpdr::recorder {

/// YAML list of one profile for the channel metadata "offered_qos_profiles".
std::string offered_qos_profiles(const dds::WriterInfo& writer);

}  // namespace vpdr::recorder
