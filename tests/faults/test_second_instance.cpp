// A service that is started twice for one walker: the second one leaves, and the walk of the first
// does not notice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "core/errors.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"

namespace vpdr::testing_support {
namespace {

constexpr int kWalkSeconds = 20;
constexpr int kImuHz = 200;

/// imu_gateway and pdr on a simulated walk, faster than life.
class OneWalk {
 public:
  OneWalk(std::uint32_t domain_id, const std::string& rate)
      : domain(domain_id),
        imu(domain.participant(), dds::topics::kImuRaw),
        odometry(domain.participant(), dds::topics::kPdrOdometry),
        pdr(domain.start("pdr", {"--wait-for", "imu_gateway", "--until-end"})),
        gateway(domain.start("imu_gateway",
                             {"--wait-for", "pdr", "--until-end", "--simulate", "--duration",
                              std::to_string(kWalkSeconds), "--rate", rate})) {}

  /// Both end in order and at the end of the walk.
  void expect_whole() {
    EXPECT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
    EXPECT_EQ(pdr.wait(kPatience), 0) << pdr.last_lines(5);
    // But for those before the observer was matched.
    EXPECT_TRUE(odometry.wait_count(kWalkSeconds * kImuHz * 9 / 10, 5s)) << domain.describe("pdr");
  }

  TestDomain domain;
  Collector<sensor_msgs::msg::Imu> imu;
  Collector<nav_msgs::msg::Odometry> odometry;
  tool::ChildProcess pdr;
  tool::ChildProcess gateway;
};

TEST(SecondInstance, AGatewayThatNeedNotWaitSendsNothingIntoTheWalk) {
  OneWalk walk(154, "4");
  ASSERT_TRUE(walk.odometry.wait_count(100)) << walk.gateway.last_lines(3);
  for (int i = 0; i < 3; ++i) {
    auto second = walk.domain.start("imu_gateway", {"--simulate", "--rate", "0"});
    EXPECT_EQ(second.wait(kPatience), static_cast<int>(ExitCode::kDds)) << second.last_lines(3);
  }
  EXPECT_EQ(walk.gateway.exit_code(), std::nullopt) << "the first walk must still be going on";
  walk.expect_whole();
  TimestampNs last_ns = -1;
  for (const auto& message : walk.imu.messages()) {
    const TimestampNs stamp_ns = dds::from_msg(message.header().stamp());
    ASSERT_GT(stamp_ns, last_ns) << "a sample of another walk";
    last_ns = stamp_ns;
  }
}

TEST(SecondInstance, WhatAnotherParticipantSaysOfAServiceIsNotBelieved) {
  // Slow enough that the hand-over of a pdr that leaves does not last to the end of the walk.
  OneWalk walk(155, "1.5");
  ASSERT_TRUE(walk.odometry.wait_count(100)) << walk.gateway.last_lines(3);
  // pdr has heard the gateway itself before this.
  ASSERT_TRUE(walk.domain.wait_diagnostic("imu_gateway", "state", "running"));
  walk.domain.say("imu_gateway", app::ServiceState::kFinished);
  walk.expect_whole();
}

TEST(SecondInstance, AServiceThatNeverStartedDoesNotSayThatItHasFinished) {
  TestDomain domain(156);
  auto fusion = domain.start("fusion", {"--wait-for", "imu_gateway,pdr", "--until-end"});
  ASSERT_TRUE(domain.wait_diagnostic("fusion", "state", "waiting"));
  fusion.signal(SIGTERM);
  EXPECT_EQ(fusion.wait(kPatience), 0) << fusion.last_lines(5);
  EXPECT_EQ(domain.diagnostic_of("fusion", "state"), "waiting");
}

}  // namespace
}  // namespace vpdr::testing_support
