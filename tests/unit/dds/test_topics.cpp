#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "dds/topics.hpp"
#include "dds/types.hpp"

namespace vpdr::dds {
namespace {

template <class T>
void expect_type(const Topic<T>& topic) {
  EXPECT_EQ(topic.info.type, message_type<T>().name) << topic.info.name;
  const auto found = topics::find(topic.info.name);
  ASSERT_TRUE(found.has_value()) << topic.info.name;
  EXPECT_EQ(found->type, topic.info.type);
}

TEST(Topics, EachIsInTheTableUnderItsOwnType) {
  const auto every = std::tuple(
      topics::kImuRaw, topics::kMag, topics::kPressure, topics::kTemperature, topics::kAttitude,
      topics::kStep, topics::kHeading, topics::kPdrOdometry, topics::kCorridorHeading,
      topics::kHeadingRate, topics::kMotion, topics::kLoop, topics::kVisionOdometry, topics::kImage,
      topics::kFusedPose, topics::kFusedOdometry, topics::kFusionState, topics::kPath,
      topics::kCalibration, topics::kDiagnostics, topics::kProgress);
  std::apply([](const auto&... topic) { (expect_type(topic), ...); }, every);
  EXPECT_EQ(topics::all().size(), std::tuple_size_v<decltype(every)>);
}

TEST(Topics, NamesAreUnique) {
  std::set<std::string_view> names;
  for (const auto& topic : topics::all()) EXPECT_TRUE(names.insert(topic.name).second);
  EXPECT_FALSE(topics::find("imu").has_value());
}

TEST(Topics, QualitiesAreThoseOfTheDesign) {
  for (const auto& topic : topics::all()) {
    const bool latched = topic.name == "fusion/path" || topic.name == "calibration" ||
                         topic.name == "playback/progress";
    EXPECT_EQ(topic.qos.transient_local, latched) << topic.name;
    EXPECT_EQ(topic.qos.reliable, topic.name != "camera/image/compressed") << topic.name;
    EXPECT_EQ(topic.qos.deadline_s > 0.0, topic.name.starts_with("imu/")) << topic.name;
  }
  EXPECT_EQ(topics::kStep.info.qos.depth, 100);
  EXPECT_EQ(topics::kImage.info.qos.depth, 4);
}

TEST(Topics, PathAndItsInverse) {
  EXPECT_EQ(topic_path("ann", "imu/data_raw"), "rt/ann/imu/data_raw");
  const auto parsed = parse_topic_path("rt/ann/imu/data_raw");
  ASSERT_TRUE(parsed.has_value());
  EXPECT_EQ(parsed->walker, "ann");
  EXPECT_EQ(parsed->name, "imu/data_raw");
  for (const char* other : {"", "rt/", "rt/ann", "rt/ann/", "rt//x", "rq/ann/x", "ann/x"}) {
    EXPECT_FALSE(parse_topic_path(other).has_value()) << other;
  }
}

TEST(Topics, WalkerNamesAreRosNamespaces) {
  for (const char* good : {"a", "Ann", "walker_7"}) EXPECT_TRUE(is_walker_name(good)) << good;
  for (const char* bad : {"", "7up", "_a", "a-b", "a/b", "a b", "\xc3\xa4"}) {
    EXPECT_FALSE(is_walker_name(bad)) << bad;
  }
  EXPECT_TRUE(is_walker_name(std::string(100, 'a')));
  EXPECT_FALSE(is_walker_name(std::string(101, 'a')));
}

TEST(TypeNames, WireAndRosFormsAreInverse) {
  EXPECT_EQ(wire_type_name("sensor_msgs/msg/Imu"), "sensor_msgs::msg::dds_::Imu_");
  EXPECT_EQ(ros_type_name("sensor_msgs::msg::dds_::Imu_"), "sensor_msgs/msg/Imu");
  EXPECT_EQ(ros_type_name("HelloWorld"), "HelloWorld");
  EXPECT_EQ(wire_type_name("HelloWorld"), "HelloWorld");
}

}  // namespace
}  // namespace vpdr::dds
