// Every type over the wire: typed and raw readers of the same topic, against CDR made here.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "tests/unit/dds/fill.hpp"
#include "tests/unit/dds/loopback.hpp"

namespace vpdr::dds::test {
namespace {

constexpr std::uint32_t kDomain = 102;

using AllTypes = ::testing::Types<
    builtin_interfaces::msg::Time, builtin_interfaces::msg::Duration, std_msgs::msg::Header,
    geometry_msgs::msg::Point, geometry_msgs::msg::Vector3, geometry_msgs::msg::Quaternion,
    geometry_msgs::msg::Pose, geometry_msgs::msg::PoseWithCovariance,
    geometry_msgs::msg::PoseStamped, geometry_msgs::msg::PoseWithCovarianceStamped,
    geometry_msgs::msg::Twist, geometry_msgs::msg::TwistWithCovariance, sensor_msgs::msg::Imu,
    sensor_msgs::msg::MagneticField, sensor_msgs::msg::FluidPressure, sensor_msgs::msg::Temperature,
    sensor_msgs::msg::CompressedImage, nav_msgs::msg::Odometry, nav_msgs::msg::Path,
    diagnostic_msgs::msg::KeyValue, diagnostic_msgs::msg::DiagnosticStatus,
    diagnostic_msgs::msg::DiagnosticArray, vpdr_msgs::msg::Step, vpdr_msgs::msg::Heading,
    vpdr_msgs::msg::CorridorHeading, vpdr_msgs::msg::HeadingRate, vpdr_msgs::msg::Motion,
    vpdr_msgs::msg::Loop, vpdr_msgs::msg::Calibration, vpdr_msgs::msg::FusionState,
    vpdr_msgs::msg::Progress>;

using Bytes = std::vector<std::byte>;

template <class T>
Bytes cdr_of(const T& message) {
  Bytes bytes(4096);
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  message.serialize(cdr);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

/// RTPS sends multiples of four bytes.
Bytes padded(Bytes bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

template <class T>
class RoundTrip : public ::testing::Test {};
TYPED_TEST_SUITE(RoundTrip, AllTypes);

// One pair of participants for all types: making them takes longer than the tests.
const Participant& sender() {
  static const Participant kSender(loopback(kDomain, "sender"));
  return kSender;
}
const Participant& receiver() {
  static const Participant kReceiver(loopback(kDomain, "receiver"));
  return kReceiver;
}

TYPED_TEST(RoundTrip, TypedAndRawReadersGetWhatWasSent) {
  const std::string_view type = message_type<TypeParam>().name;
  const Topic<TypeParam> topic{{type, type, "", {}}};
  Collected<TypeParam> typed;
  Collected<Bytes> raw;
  Subscription<TypeParam> subscription(
      receiver(), topic, [&](const TypeParam& m, const SampleInfo&) { typed.add(m); });
  RawSubscription raw_subscription(receiver(),
                                   {.topic = topic_path("tester", type), .type = std::string(type)},
                                   [&](std::span<const std::byte> bytes, const SampleInfo&) {
                                     raw.add({bytes.begin(), bytes.end()});
                                   });
  Publisher<TypeParam> publisher(sender(), topic);
  ASSERT_TRUE(publisher.wait_for_matched(2, kPatience));
  TypeParam message;
  Filler().fill(message);
  ASSERT_NE(message, TypeParam());
  ASSERT_TRUE(publisher.publish(message));
  ASSERT_TRUE(typed.wait_for(1));
  ASSERT_TRUE(raw.wait_for(1));
  EXPECT_EQ(typed.items()[0], message);
  EXPECT_EQ(raw.items()[0], padded(cdr_of(message)));

  // What was recorded can be sent again.
  RawPublisher replay(sender(), {.topic = topic_path("tester", type), .type = std::string(type)});
  ASSERT_TRUE(replay.wait_for_matched(2, kPatience));
  ASSERT_TRUE(replay.publish(raw.items()[0]));
  ASSERT_TRUE(typed.wait_for(2));
  EXPECT_EQ(typed.items()[1], message);
}

// The layout that ROS 2 writes for sensor_msgs/msg/Imu, by hand: 4 bytes of encapsulation; then
// stamp 8, length of the frame 4, "imu_link" and its zero 9, 3 to reach a multiple of 8; then 37
// doubles.
TEST(WireLayout, ImuIsAsRos2WritesIt) {
  sensor_msgs::msg::Imu imu;
  imu.header().stamp().sec(0x01020304);
  imu.header().stamp().nanosec(5);
  imu.header().frame_id("imu_link");
  imu.orientation().x(2.0);  // first double: 0x4000000000000000
  imu.linear_acceleration_covariance()[8] = -2.0;
  const Bytes bytes = cdr_of(imu);
  ASSERT_EQ(bytes.size(), 4U + 24 + 37 * 8);
  const auto at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
  EXPECT_EQ(at(1), 1) << "little endian";
  EXPECT_EQ(at(4), 0x04);
  EXPECT_EQ(at(7), 0x01);
  EXPECT_EQ(at(8), 5);
  EXPECT_EQ(at(12), 9);
  EXPECT_EQ(at(16), 'i');
  EXPECT_EQ(at(24), 0);
  EXPECT_EQ(at(28 + 7), 0x40);
  EXPECT_EQ(at(bytes.size() - 1), 0xc0);
}

}  // namespace
}  // namespace vpdr::dds::test
