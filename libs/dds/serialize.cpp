#include "dds/serialize.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <exception>

namespace vpdr::dds {

namespace {

constexpr std::size_t kEncapsulationBytes = 4;

}  // namespace

bool deserialize_message(std::span<const std::byte> payload, const MessageType& type,
                         void* message) {
  using eprosima::fastcdr::Cdr;
  try {
    // Fast CDR reads from a buffer that is not const, and does not write to it.
    auto* bytes = reinterpret_cast<char*>(const_cast<std::byte*>(payload.data()));
    eprosima::fastcdr::FastBuffer buffer(bytes, payload.size());
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    type.deserialize(message, cdr);
    return true;
  } catch (const std::exception&) {
    return false;  // short, or a sequence longer than memory
  }
}

std::vector<std::byte> serialize_message(const void* message, const MessageType& type) {
  using eprosima::fastcdr::Cdr;
  std::vector<std::byte> bytes(type.size(message) + kEncapsulationBytes);
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  type.serialize(message, cdr);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

}  // namespace vpdr::dds
