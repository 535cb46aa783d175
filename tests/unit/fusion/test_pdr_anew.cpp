// A pdr that was killed and started again, in the middle of a walk.
#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "fusion/core/walker_filter.hpp"

namespace vpdr::fusion {
namespace {

TEST(CorrelatedHeading, APdrThatStartsAnewTurnsOnlyWhatIsWalkedSince) {
  const WalkerFilter filter(FusionConfig{});
  FilterState state = filter.initial();
  const auto told = [&](double at_s, double yaw, double sigma, double revision, bool absolute) {
    filter.apply(HeadingEstimate{.stamp_ns = to_ns(at_s),
                                 .yaw_rad = yaw,
                                 .yaw_sigma_rad = sigma,
                                 .yaw_is_absolute = absolute,
                                 .yaw_zero_sigma_rad = sigma,
                                 .yaw_revision_rad = revision},
                 state);
  };
  const auto walk = [&](double at_s, double yaw, double revision) {
    StepEvent step;
    step.stamp_ns = to_ns(at_s);
    step.length_m = 10.0;
    step.yaw_rad = yaw;
    step.yaw_sigma_rad = 0.1;
    step.yaw_revision_rad = revision;
    filter.apply(step, state);
  };
  told(0.0, 0.0, 0.1, 0.0, false);
  told(0.05, 0.5 * kPi, 0.1, 0.5 * kPi, true);  // north is found: it was ahead
  walk(0.1, 0.5 * kPi, 0.5 * kPi);
  EXPECT_NEAR(state.x[kY], 10.0, 0.1);
  // Another pdr, five seconds later; the walker faces east now. It does not know north at first.
  told(5.0, 0.3, 1.8, 0.0, false);
  EXPECT_NEAR(state.x[kX], 0.0, 0.1);
  EXPECT_NEAR(state.x[kY], 10.0, 0.1);
  walk(5.05, 0.3, 0.0);
  told(5.1, 0.0, 0.1, -0.3, true);
  EXPECT_NEAR(state.x[kX], 10.0, 1.0) << "walked since, turned about where it began";
  EXPECT_NEAR(state.x[kY], 10.0, 1.0);
  EXPECT_NEAR(state.x[kYaw], 0.0, 0.1);
  EXPECT_LT(std::sqrt(state.p(kX, kX)), 3.0);
  EXPECT_LT(std::sqrt(state.p(kY, kY)), 3.0);
}

}  // namespace
}  // namespace vpdr::fusion
