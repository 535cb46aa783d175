#pragma once
// The one type support of all topics. A sample given to Fast DDS, or asked from it, is an Envelope:
// either a message with its type, or the raw bytes. So typed and raw endpoints of the same type
// live in one participant, and the fastddsgen type supports are not needed.
#include <cstddef>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <span>
#include <vector>

#include "dds/types.hpp"

namespace vpdr::dds::detail {

struct Envelope {
  const MessageType* type = nullptr;           ///< null: raw
  const void* message = nullptr;               ///< to serialise
  void* target = nullptr;                      ///< to deserialise into
  std::vector<std::byte>* raw = nullptr;       ///< to copy into, encapsulation header included
  std::span<const std::byte> bytes_to_send{};  ///< raw sample to send, encapsulation included
  bool readable = true;                        ///< false: the bytes received do not fit the type
};

/// Type support under one name on the wire. Stateless but for the name.
class EnvelopeType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit EnvelopeType(const std::string& wire_name);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new Envelope; }
  void deleteData(void* data) override { delete static_cast<Envelope*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace vpdr::dds::detail
