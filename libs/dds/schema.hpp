#pragma once
// The message definitions of idl/, as the build found them.
#include <string>
#include <string_view>

namespace vpdr::dds {

/// Hash of the IDL this program was built with, 16 hexadecimal digits. Comments and white space do
/// not count. Programs with different hashes do not understand each other's topics.
std::string_view idl_hash();

/// Definition of a type in the `ros2msg` schema encoding of MCAP: its .msg text, then that of each
/// type it is made of, under a line of 80 "=" and "MSG: package/Type". Takes "sensor_msgs/msg/Imu".
/// Empty for a type that is not in idl/.
std::string ros2msg_schema(std::string_view ros_type);

}  // namespace vpdr::dds
