#include "dds/detail/envelope.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstring>
#include <exception>

#include "dds/serialize.hpp"

namespace vpdr::dds::detail {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::uint32_t kEncapsulationBytes = 4;
// Histories allocate by the true size of each sample; this is only where they begin.
constexpr std::uint32_t kTypicalBytes = 512;

bool serialize_message(const Envelope& envelope, SerializedPayload_t& payload) {
  FastBuffer buffer(reinterpret_cast<char*>(payload.data), payload.max_size);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  payload.encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
  cdr.serialize_encapsulation();
  envelope.type->serialize(envelope.message, cdr);
  payload.length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
  return true;
}

bool serialize_bytes(std::span<const std::byte> bytes, SerializedPayload_t& payload) {
  if (bytes.size() < kEncapsulationBytes || bytes.size() > payload.max_size) return false;
  std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.encapsulation = std::to_integer<int>(bytes[1]) == 0 ? CDR_BE : CDR_LE;
  payload.length = static_cast<std::uint32_t>(bytes.size());
  return true;
}

}  // namespace

EnvelopeType::EnvelopeType(const std::string& wire_name) {
  setName(wire_name.c_str());
  m_typeSize = kTypicalBytes;
  m_isGetKeyDefined = false;
  // With a TypeObject or TypeInformation in discovery other vendors' readers reject the writer.
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool EnvelopeType::serialize(void* data, SerializedPayload_t* payload) {
  const auto& envelope = *static_cast<const Envelope*>(data);
  try {
    return envelope.type != nullptr ? serialize_message(envelope, *payload)
                                    : serialize_bytes(envelope.bytes_to_send, *payload);
  } catch (const std::exception&) {
    return false;  // the message is larger than it said: never a torn sample
  }
}

bool EnvelopeType::deserialize(SerializedPayload_t* payload, void* data) {
  auto& envelope = *static_cast<Envelope*>(data);
  const std::span bytes(reinterpret_cast<const std::byte*>(payload->data), payload->length);
  if (envelope.raw != nullptr) {
    envelope.raw->assign(bytes.begin(), bytes.end());
  } else {
    // The reader counts what is not readable.
    envelope.readable = deserialize_message(bytes, *envelope.type, envelope.target);
  }
  return true;
}

std::function<std::uint32_t()> EnvelopeType::getSerializedSizeProvider(void* data) {
  return [data] {
    const auto& envelope = *static_cast<const Envelope*>(data);
    if (envelope.type == nullptr) return static_cast<std::uint32_t>(envelope.bytes_to_send.size());
    return static_cast<std::uint32_t>(envelope.type->size(envelope.message)) + kEncapsulationBytes;
  };
}

}  // namespace vpdr::dds::detail
