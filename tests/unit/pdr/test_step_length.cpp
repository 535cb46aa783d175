#include <gtest/gtest.h>

#include "pdr/core/step_length.hpp"

namespace vpdr::pdr {
namespace {

TEST(StepLength, IsLinearInFrequency) {
  StepLengthConfig config;
  config.alpha_m_per_hz = 0.3;
  config.beta_m = 0.1;
  // S1.2 with t_k - t_(k-1) = 0.5 s: 0.3 / 0.5 + 0.1.
  EXPECT_DOUBLE_EQ(step_length(config, 1.0 / 0.5).length_m, 0.7);
  EXPECT_DOUBLE_EQ(step_length(config, 1.0).length_m, 0.4);
}

TEST(StepLength, DefaultIsTheWalkRatio) {
  // 0.385 m/Hz at 1.8 Hz.
  EXPECT_NEAR(step_length({}, 1.8).length_m, 0.693, 1e-12);
}

TEST(StepLength, StaysWithinItsRange) {
  const StepLengthConfig config;
  EXPECT_DOUBLE_EQ(step_length(config, 0.1).length_m, config.shortest_m);
  EXPECT_DOUBLE_EQ(step_length(config, 9.0).length_m, config.longest_m);
}

TEST(StepLength, SigmaHoldsPersonAndStep) {
  StepLengthConfig config;
  config.scale_sigma = 0.03;
  config.step_sigma = 0.04;
  EXPECT_NEAR(step_length(config, 2.0).sigma_m, 0.77 * 0.05, 1e-12);
}

}  // namespace
}  // namespace vpdr::pdr
