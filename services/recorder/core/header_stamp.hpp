#pragma once
// The stamp of a message that begins with std_msgs/Header, without decoding the rest.
#include <cstddef>
#include <optional>
#include <span>

#include "core/time.hpp"

namespace vpdr::recorder {

/// `payload`: plain CDR with its 4 bytes of encapsulation, then int32 seconds and uint32
/// nanoseconds. Nothing for a payload that is shorter or of another encoding.
std::optional<TimestampNs> header_stamp(std::span<const std::byte> payload);

}  // namespace vpdr::recorder
