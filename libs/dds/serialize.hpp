#pragma once
// Messages to and from bytes as they are on the wire and in recordings. Thread safety: pure
// functions.
#include <cstddef>
#include <span>
#include <vector>

#include "dds/types.hpp"

namespace vpdr::dds {

/// Fills `message`, of that type, from plain CDR with its 4 bytes of encapsulation. False: the
/// bytes do not fit the type, and the message holds anything.
bool deserialize_message(std::span<const std::byte> payload, const MessageType& type,
                         void* message);

/// The same for a message type of idl/:
///
///   sensor_msgs::msg::Imu imu;
///   if (dds::deserialize(payload, imu)) ...
template <class T>
bool deserialize(std::span<const std::byte> payload, T& message) {
  return deserialize_message(payload, message_type<T>(), &message);
}

/// Plain little-endian CDR with its 4 bytes of encapsulation.
std::vector<std::byte> serialize_message(const void* message, const MessageType& type);

template <class T>
std::vector<std::byte> serialize(const T& message) {
  return serialize_message(&message, message_type<T>());
}

}  // namespace vpdr::dds
