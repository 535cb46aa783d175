#include <gtest/gtest.h>

#include <limits>

#include "dds/convert.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "unit/dds/random_values.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds {
namespace {

using test::Random;

constexpr int kRounds = 200;

template <class Msg, class Core>
Core there_and_back(const Core& core) {
  Msg msg;
  to_msg(core, msg);
  Core back;
  from_msg(msg, back);
  return back;
}

void expect_same_pose(const PoseEstimate& a, const PoseEstimate& b) {
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.world_from_body.coeffs(), b.world_from_body.coeffs());
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(Convert, StampsByHand) {
  const auto expect = [](TimestampNs stamp, std::int32_t sec, std::uint32_t nanosec) {
    builtin_interfaces::msg::Time time;
    to_msg(stamp, time);
    EXPECT_EQ(time.sec(), sec);
    EXPECT_EQ(time.nanosec(), nanosec);
    EXPECT_EQ(from_msg(time), stamp);
  };
  expect(0, 0, 0);
  expect(1'403'636'579'763'555'584, 1'403'636'579, 763'555'584);
  expect(-1, -1, 999'999'999);
  expect(-kNsPerSecond, -1, 0);
  expect(-kNsPerSecond - 1, -2, 999'999'999);
}

TEST(Convert, StampsBeyondTheWireAreHeldAtItsEnds) {
  builtin_interfaces::msg::Time time;
  to_msg(std::numeric_limits<TimestampNs>::max(), time);
  EXPECT_EQ(time.sec(), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(time.nanosec(), 999'999'999U);
  to_msg(std::numeric_limits<TimestampNs>::min(), time);
  EXPECT_EQ(time.sec(), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(time.nanosec(), 0U);
}

TEST(Convert, ImuSample) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const ImuSample sample{random.stamp(), random.vector(), random.vector(), random.flag()};
    const auto back = there_and_back<sensor_msgs::msg::Imu>(sample);
    EXPECT_EQ(back.stamp_ns, sample.stamp_ns);
    EXPECT_EQ(back.specific_force_mps2, sample.specific_force_mps2);
    EXPECT_EQ(back.angular_velocity_radps, sample.angular_velocity_radps);
    EXPECT_EQ(back.has_angular_velocity, sample.has_angular_velocity);
  }
}

TEST(Convert, ImuMessageSaysWhatIsAbsent) {
  sensor_msgs::msg::Imu msg;
  to_msg(ImuSample{.has_angular_velocity = true}, msg);
  EXPECT_EQ(msg.header().frame_id(), "imu_link");
  EXPECT_EQ(msg.orientation_covariance()[0], -1.0);
  EXPECT_EQ(msg.angular_velocity_covariance()[0], 0.0);
  to_msg(ImuSample{.has_angular_velocity = false}, msg);
  EXPECT_EQ(msg.angular_velocity_covariance()[0], -1.0);
  // The same message object serves the next sample: nothing of the last one stays.
  to_msg(AttitudeEstimate{}, msg);
  EXPECT_EQ(msg.header().frame_id(), "base_link");
  EXPECT_EQ(msg.orientation_covariance()[0], 0.0);
  EXPECT_EQ(msg.angular_velocity_covariance()[0], 0.0);
}

TEST(Convert, MagSampleIsTeslaOnTheWire) {
  const MagSample sample{5, {20.0, -3.5, 41.0}};
  sensor_msgs::msg::MagneticField msg;
  to_msg(sample, msg);
  EXPECT_DOUBLE_EQ(msg.magnetic_field().x(), 20.0e-6);
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const MagSample original{random.stamp(), random.vector()};
    const auto back = there_and_back<sensor_msgs::msg::MagneticField>(original);
    EXPECT_EQ(back.stamp_ns, original.stamp_ns);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_DOUBLE_EQ(back.field_ut[axis], original.field_ut[axis]);
    }
  }
}

TEST(Convert, PressureSample) {
  const PressureSample sample{-7, 101'325.25};
  const auto back = there_and_back<sensor_msgs::msg::FluidPressure>(sample);
  EXPECT_EQ(back.stamp_ns, -7);
  EXPECT_EQ(back.pressure_pa, 101'325.25);
}

TEST(Convert, Temperature) {
  const auto back = there_and_back<sensor_msgs::msg::Temperature>(TimedValue{-7, -12.5});
  EXPECT_EQ(back.stamp_ns, -7);
  EXPECT_EQ(back.value, -12.5);
}

TEST(Convert, AttitudeEstimate) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const AttitudeEstimate original{
        random.stamp(),  random.rotation(), random.matrix<Eigen::Matrix3d>(),
        random.vector(), random.vector(),   false};
    const auto back = there_and_back<sensor_msgs::msg::Imu>(original);
    EXPECT_EQ(back.stamp_ns, original.stamp_ns);
    EXPECT_EQ(back.world_from_body.coeffs(), original.world_from_body.coeffs());
    EXPECT_EQ(back.covariance_rad2, original.covariance_rad2);
    EXPECT_EQ(back.angular_velocity_radps, original.angular_velocity_radps);
    EXPECT_EQ(back.specific_force_mps2, original.specific_force_mps2);
  }
}

TEST(Convert, QuaternionAndCovarianceStandWhereRosExpectsThem) {
  PoseEstimate pose;
  pose.world_from_body = {0.1, 0.2, 0.3, 0.4};  // w x y z
  pose.covariance(0, 5) = 7.0;
  pose.covariance(5, 0) = 8.0;
  nav_msgs::msg::Odometry msg;
  to_msg(pose, Frame::kOdom, msg);
  EXPECT_EQ(msg.header().frame_id(), "odom");
  EXPECT_EQ(msg.child_frame_id(), "base_link");
  EXPECT_EQ(msg.pose().pose().orientation().w(), 0.1);
  EXPECT_EQ(msg.pose().pose().orientation().x(), 0.2);
  EXPECT_EQ(msg.pose().pose().orientation().z(), 0.4);
  EXPECT_EQ(msg.pose().covariance()[5], 7.0);
  EXPECT_EQ(msg.pose().covariance()[30], 8.0);
}

TEST(Convert, PoseEstimate) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const PoseEstimate original = random.pose();
    nav_msgs::msg::Odometry odometry;
    to_msg(original, Frame::kMap, odometry);
    PoseEstimate back;
    from_msg(odometry, back);
    expect_same_pose(back, original);
    EXPECT_EQ(back.angular_velocity_radps, original.angular_velocity_radps);
    EXPECT_EQ(back.speed_mps, original.speed_mps);

    geometry_msgs::msg::PoseWithCovarianceStamped stamped;
    to_msg(original, Frame::kMap, stamped);
    EXPECT_EQ(stamped.header().frame_id(), "map");
    PoseEstimate back_from_stamped;
    from_msg(stamped, back_from_stamped);
    expect_same_pose(back_from_stamped, original);

    geometry_msgs::msg::PoseStamped point;
    to_msg(original, Frame::kMap, point);
    EXPECT_EQ(point.pose().position().y(), original.position_m.y());
    EXPECT_EQ(from_msg(point.header().stamp()), original.stamp_ns);
  }
}

TEST(Convert, StepAndHeading) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const StepEvent step{random.stamp(),         random.index(),  random.number(), random.number(),
                         random.number(),        random.number(), random.number(), random.number(),
                         StepStatus::kWithdrawn, random.number()};
    const auto step_back = there_and_back<vpdr_msgs::msg::Step>(step);
    EXPECT_EQ(step_back.stamp_ns, step.stamp_ns);
    EXPECT_EQ(step_back.index, step.index);
    EXPECT_EQ(step_back.length_m, step.length_m);
    EXPECT_EQ(step_back.length_sigma_m, step.length_sigma_m);
    EXPECT_EQ(step_back.frequency_hz, step.frequency_hz);
    EXPECT_EQ(step_back.yaw_rad, step.yaw_rad);
    EXPECT_EQ(step_back.yaw_sigma_rad, step.yaw_sigma_rad);
    EXPECT_EQ(step_back.yaw_revision_rad, step.yaw_revision_rad);
    EXPECT_EQ(step_back.status, step.status);
    EXPECT_EQ(step_back.probability, step.probability);

    const HeadingEstimate heading{random.stamp(), random.number(), random.number(),
                                  random.flag(),  random.number(), random.number()};
    const auto heading_back = there_and_back<vpdr_msgs::msg::Heading>(heading);
    EXPECT_EQ(heading_back.stamp_ns, heading.stamp_ns);
    EXPECT_EQ(heading_back.yaw_rad, heading.yaw_rad);
    EXPECT_EQ(heading_back.yaw_sigma_rad, heading.yaw_sigma_rad);
    EXPECT_EQ(heading_back.yaw_is_absolute, heading.yaw_is_absolute);
    EXPECT_EQ(heading_back.yaw_zero_sigma_rad, heading.yaw_zero_sigma_rad);
    EXPECT_EQ(heading_back.yaw_revision_rad, heading.yaw_revision_rad);
  }
}

TEST(Convert, Motion) {
  MotionEstimate motion;
  motion.stamp_ns = 17;
  motion.interval_start_ns = 5;
  motion.translation_m = {0.1, -0.2, 0.3};
  motion.rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  for (int i = 0; i < 36; ++i) motion.covariance(i / 6, i % 6) = i + 1;
  motion.metric = true;
  motion.inliers = 42;
  const auto back = there_and_back<vpdr_msgs::msg::Motion>(motion);
  EXPECT_EQ(back.stamp_ns, motion.stamp_ns);
  EXPECT_EQ(back.interval_start_ns, motion.interval_start_ns);
  EXPECT_EQ(back.translation_m, motion.translation_m);
  EXPECT_EQ(back.rotation.coeffs(), motion.rotation.coeffs());
  EXPECT_EQ(back.covariance, motion.covariance);
  EXPECT_TRUE(back.metric);
  EXPECT_EQ(back.inliers, 42U);
}

TEST(Convert, CorridorHeadingAndHeadingRate) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const CorridorHeading heading{random.stamp(),  random.flag(),   random.number(),
                                  random.number(), random.number(), random.index()};
    const auto heading_back = there_and_back<vpdr_msgs::msg::CorridorHeading>(heading);
    EXPECT_EQ(heading_back.stamp_ns, heading.stamp_ns);
    EXPECT_EQ(heading_back.found, heading.found);
    EXPECT_EQ(heading_back.heading_rad, heading.heading_rad);
    EXPECT_EQ(heading_back.pitch_rad, heading.pitch_rad);
    EXPECT_EQ(heading_back.sigma_rad, heading.sigma_rad);
    EXPECT_EQ(heading_back.inliers, heading.inliers);

    const HeadingRate rate{random.stamp(), random.stamp(), random.number(), random.number()};
    const auto rate_back = there_and_back<vpdr_msgs::msg::HeadingRate>(rate);
    EXPECT_EQ(rate_back.stamp_ns, rate.stamp_ns);
    EXPECT_EQ(rate_back.interval_start_ns, rate.interval_start_ns);
    EXPECT_EQ(rate_back.rate_radps, rate.rate_radps);
    EXPECT_EQ(rate_back.sigma_radps, rate.sigma_radps);
  }
}

TEST(Convert, FusedPose) {
  Random random;
  for (int i = 0; i < kRounds; ++i) {
    const FusedPose original{random.pose(), random.number(), random.number(), random.number(),
                             static_cast<FusionMode>(random.index() % 4)};
    const auto back = there_and_back<vpdr_msgs::msg::FusionState>(original);
    expect_same_pose(back.pose, original.pose);
    EXPECT_EQ(back.pose.angular_velocity_radps, original.pose.angular_velocity_radps);
    EXPECT_EQ(back.pose.speed_mps, original.pose.speed_mps);
    EXPECT_EQ(back.yaw_rad, original.yaw_rad);
    EXPECT_EQ(back.yaw_rate_radps, original.yaw_rate_radps);
    EXPECT_EQ(back.distance_m, original.distance_m);
    EXPECT_EQ(back.mode, original.mode);
  }
}

TEST(Convert, UnknownModeIsWaiting) {
  vpdr_msgs::msg::FusionState msg;
  msg.mode(200);
  FusedPose pose;
  pose.mode = FusionMode::kInertial;
  from_msg(msg, pose);
  EXPECT_EQ(pose.mode, FusionMode::kWaiting);
}

}  // namespace
}  // namespace vpdr::dds
