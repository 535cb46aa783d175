#include <gtest/gtest.h>

#include <Eigen/LU>

#include "fusion/core/heading_rate_model.hpp"

namespace vpdr::fusion {
namespace {

TEST(HeadingRateModel, TransitionOfTheCorrectedFormIntegratesTheRate) {
  // theta_dot 0.2 rad/s, theta 1 rad, 0.5 s: theta = 1 + 0.2 * 0.5 = 1.1, the rate unchanged.
  const Eigen::Vector2d after =
      heading_rate_transition(0.5, TransitionForm::kCorrected) * Eigen::Vector2d(0.2, 1.0);
  EXPECT_DOUBLE_EQ(after[0], 0.2);
  EXPECT_DOUBLE_EQ(after[1], 1.1);
}

TEST(HeadingRateModel, TransitionAsPrintedForgetsTheHeading) {
  // (9) as printed: a walker who looks along 1 rad and does not turn is said to look along 0.
  const Eigen::Matrix2d printed = heading_rate_transition(0.5, TransitionForm::kAsPrinted);
  EXPECT_DOUBLE_EQ((printed * Eigen::Vector2d(0.0, 1.0))[1], 0.0);
  EXPECT_DOUBLE_EQ((printed * Eigen::Vector2d(0.2, 1.0))[1], 0.1);
  // It is even singular: two different pasts become one present.
  EXPECT_DOUBLE_EQ(printed.determinant(), 0.0);
  EXPECT_DOUBLE_EQ(heading_rate_transition(0.5, TransitionForm::kCorrected).determinant(), 1.0);
}

TEST(HeadingRateModel, ProcessNoiseIsWhiteAngularAccelerationIntegrated) {
  // density 3 over 2 s: rate 3*2 = 6, cross 3*4/2 = 6, heading 3*8/3 = 8.
  const Eigen::Matrix2d q = heading_rate_process_noise(2.0, 3.0);
  EXPECT_DOUBLE_EQ(q(0, 0), 6.0);
  EXPECT_DOUBLE_EQ(q(0, 1), 6.0);
  EXPECT_DOUBLE_EQ(q(1, 0), 6.0);
  EXPECT_DOUBLE_EQ(q(1, 1), 8.0);
}

TEST(HeadingRateModel, NoiseOfTwoHalvesIsTheNoiseOfTheWhole) {
  const Eigen::Matrix2d f = heading_rate_transition(0.7, TransitionForm::kCorrected);
  const Eigen::Matrix2d q = heading_rate_process_noise(0.7, 1.3);
  const Eigen::Matrix2d twice = f * q * f.transpose() + q;
  EXPECT_TRUE(twice.isApprox(heading_rate_process_noise(1.4, 1.3), 1e-12));
}

}  // namespace
}  // namespace vpdr::fusion
