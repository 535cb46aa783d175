#include <gtest/gtest.h>

#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "tests/unit/dds/loopback.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds::test {
namespace {

constexpr std::uint32_t kDomain = 100;

class Endpoints : public ::testing::Test {
 protected:
  Participant sender_{loopback(kDomain, "sender")};
  Participant receiver_{loopback(kDomain, "receiver")};
};

vpdr_msgs::msg::Step step(std::uint32_t index) {
  vpdr_msgs::msg::Step message;
  message.index(index);
  return message;
}

TEST_F(Endpoints, SamplesArriveInOrder) {
  Collected<std::uint32_t> seen;
  Subscription subscription(
      receiver_, topics::kStep,
      [&](const vpdr_msgs::msg::Step& message, const SampleInfo&) { seen.add(message.index()); });
  Publisher publisher(sender_, topics::kStep);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  ASSERT_TRUE(subscription.wait_for_matched(1, kPatience));
  for (std::uint32_t i = 1; i <= 50; ++i) ASSERT_TRUE(publisher.publish(step(i)));
  ASSERT_TRUE(seen.wait_for(50));
  const auto items = seen.items();
  for (std::uint32_t i = 1; i <= 50; ++i) EXPECT_EQ(items[i - 1], i);
}

}  // namespace
}  // namespace vpdr::dds::test
