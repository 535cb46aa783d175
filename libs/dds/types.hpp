#pragma once
// What a message type is to the endpoints: its name and how it is put on the wire. Defined for
// every type of idl/; the generated headers ("sensor_msgs.h", ...) are included by the user.
#include <cstddef>
#include <string>
#include <string_view>

namespace eprosima::fastcdr {
class Cdr;
}

namespace vpdr::dds {

/// The operations on a sample behind a pointer. One constant object for each type.
struct MessageType {
  std::string_view name;                    ///< as ROS writes it: "sensor_msgs/msg/Imu"
  std::size_t (*size)(const void* sample);  ///< bytes on the wire, no encapsulation header
  void (*serialize)(const void* sample, eprosima::fastcdr::Cdr& cdr);
  void (*deserialize)(void* sample, eprosima::fastcdr::Cdr& cdr);
};

/// The type T, one of those in idl/; any other does not link.
template <class T>
const MessageType& message_type();

/// Name on the wire of a ROS type: "sensor_msgs::msg::dds_::Imu_" of "sensor_msgs/msg/Imu".
std::string wire_type_name(std::string_view ros_name);

/// The inverse: "sensor_msgs/msg/Imu" of "sensor_msgs::msg::dds_::Imu_". A name that is not of
/// that form comes back as it is.
std::string ros_type_name(std::string_view wire_name);

}  // namespace vpdr::dds
