#include <gtest/gtest.h>

#include "dds/convert.hpp"
#include "sensor_msgs.h"

namespace vpdr::dds {
namespace {

TEST(Convert, NegativeStampsCountNanosecondsUpwards) {
  builtin_interfaces::msg::Time time;
  to_msg(TimestampNs{-1}, time);
  EXPECT_EQ(time.sec(), -1);
  EXPECT_EQ(time.nanosec(), 999'999'999U);
  EXPECT_EQ(from_msg(time), -1);
}

}  // namespace
}  // namespace vpdr::dds
