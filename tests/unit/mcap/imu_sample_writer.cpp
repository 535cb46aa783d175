// Writes a recording of sensor_msgs/Imu messages whose CDR bytes are laid out by hand, for the
// check with the independent reader: imu_sample_writer FILE COUNT.
#include <bit>
#include <cstdlib>
#include <iostream>

#include "tests/unit/mcap/sample_file.hpp"

namespace {

using vpdr::mcap::Buffer;
using vpdr::mcap::ByteWriter;

constexpr const char* kImuSchema = R"(std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

void put_doubles(ByteWriter& w, int count, double first) {
  for (int i = 0; i < count; ++i) w.integer(std::bit_cast<std::uint64_t>(first + i));
}

/// Plain CDR, little-endian; stamp i ms, angular velocity (i, i+1, i+2), acceleration (9, 10, 11).
Buffer imu_cdr(std::uint32_t i) {
  Buffer out;
  ByteWriter w(out);
  w.integer(std::uint32_t{0x00000100});  // encapsulation 00 01: CDR_LE; options 00 00
  w.integer(std::uint32_t{1});
  w.integer(i * 1'000'000U);
  w.string(std::string_view("imu_link\0", 9));
  while ((out.size() - 4) % 8 != 0) w.integer(std::uint8_t{0});
  put_doubles(w, 4, 0.0);
  put_doubles(w, 9, 0.0);
  put_doubles(w, 3, i);
  put_doubles(w, 9, 0.0);
  put_doubles(w, 3, 9.0);
  put_doubles(w, 9, 0.0);
  return out;
}

vpdr::Status write_file(const char* path, std::uint32_t count) {
  using namespace vpdr::mcap;
  vpdr::Result<Writer> created = Writer::create(path);
  if (!created) return created.error();
  Writer writer = std::move(created.value());
  const auto schema = writer.add_schema("sensor_msgs/msg/Imu", "ros2msg", kImuSchema);
  const auto channel = writer.add_channel(
      {0, schema.value(), "rt/ann/imu/data_raw", "cdr", {{"offered_qos_profiles", ""}}});
  if (!channel) return channel.error();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Buffer data = imu_cdr(i);
    const vpdr::TimestampNs time = vpdr::kNsPerSecond + i * 10'000'000LL;
    const vpdr::Status status =
        writer.write(Message{channel.value(), i + 1, time + 500'000, time, data});
    if (!status) return status;
  }
  const vpdr::Status status = writer.write(Metadata{"vpdr.walk", {{"walker", "ann"}}});
  return status ? writer.close() : status;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: imu_sample_writer FILE COUNT\n";
    return 2;
  }
  const auto count = static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10));
  const vpdr::Status status = write_file(argv[1], count);
  if (!status) std::cerr << status.error().message << '\n';
  return status ? 0 : 1;
}
