// The hot path takes no memory: every operator new is counted.
#include <gtest/gtest.h>

#include "fusion/core/fusion.hpp"
#include "tests/support/counted_allocations.hpp"

namespace vpdr::fusion {
namespace {

TEST(Allocation, ProcessAndLatestTakeNoMemory) {
  Fusion fusion;
  const std::size_t before = vpdr::testing::allocations;
  EXPECT_GT(before, 0U);  // the counter counts: construction takes the ring
  double walked = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const TimestampNs now = i * to_ns(0.05);
    PoseEstimate odometry;
    odometry.stamp_ns = now;
    fusion.process(odometry);
    fusion.process(HeadingEstimate{now, 0.1, 0.1, false});
    if (i % 10 == 0) {
      StepEvent step;
      step.stamp_ns = now - to_ns(0.2);  // late: what follows is applied again
      step.length_m = 0.7;
      step.length_sigma_m = 0.05;
      step.yaw_sigma_rad = 0.1;
      fusion.process(step);
    }
    fusion.process(HeadingRate{now - to_ns(0.3), now - to_ns(0.35), 0.0, 0.1});
    walked = fusion.latest()->distance_m;
  }
  EXPECT_EQ(vpdr::testing::allocations, before);
  EXPECT_NEAR(walked, 70.0, 1e-9);
}

}  // namespace
}  // namespace vpdr::fusion
