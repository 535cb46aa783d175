#include <gtest/gtest.h>

#include "fusion/core/pdr_walk.hpp"

namespace vpdr::fusion {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Variances whose sums with the least one of 0.01 m^2 are round.
Matrix2d variances(double east_m2, double north_m2) {
  return Vector2d(east_m2 - 0.01, north_m2 - 0.01).asDiagonal();
}

TEST(NewsIn, IsAllOfTheBendWhereVisionToldNothing) {
  Matrix2d covariance;
  covariance << 2.0, 0.7, 0.7, 1.0;
  EXPECT_TRUE(news_in({0.3, -0.2}, covariance, covariance).isApprox(Vector2d(0.3, -0.2), 1e-12));
  // Nothing makes the position unsure yet.
  EXPECT_TRUE(news_in({0.01, 0.02}, Matrix2d::Zero(), Matrix2d::Zero())
                  .isApprox(Vector2d(0.01, 0.02), 1e-12));
}

TEST(NewsIn, IsTheShareThatVisionLeftUncertain) {
  // East 1 of 4 m^2 is left, north 1 of 2.
  EXPECT_TRUE(news_in({0.8, 0.4}, variances(1.0, 1.0), variances(4.0, 2.0))
                  .isApprox(Vector2d(0.2, 0.2), 1e-12));
  // C = [2 1; 1 2], C^-1 b = [2 -1; -1 2] b / 3 = (1, 0) for b = (2, 1); P = C less 1 north.
  Matrix2d without;
  without << 1.99, 1.0, 1.0, 1.99;
  Matrix2d with;
  with << 1.99, 1.0, 1.0, 0.99;
  EXPECT_TRUE(news_in({2.0, 1.0}, with, without).isApprox(Vector2d(2.0, 1.0), 1e-12));
  // b = (1, 2): C^-1 b = (0, 1), P (0, 1) = (1, 1).
  EXPECT_TRUE(news_in({1.0, 2.0}, with, without).isApprox(Vector2d(1.0, 1.0), 1e-12));
}

TEST(NewsIn, NoBendIsLongerThanTheFilterCanErr) {
  // Six deviations of 0.5 m: four of them count.
  const Matrix2d quarter = variances(0.25, 0.25);
  EXPECT_TRUE(news_in({3.0, 0.0}, quarter, quarter).isApprox(Vector2d(2.0, 0.0), 1e-12));
  EXPECT_TRUE(news_in({1.9, 0.0}, quarter, quarter).isApprox(Vector2d(1.9, 0.0), 1e-12));
}

TEST(BentVariance, IsThePositionsAsIfLengthAndWearWereKnown) {
  FilterState state;
  state.p.diagonal().segment<2>(kX) = Vector2d(1.0, 2.0);
  state.p(kScale, kScale) = 0.01;
  state.p(kX, kScale) = state.p(kScale, kX) = 0.05;  // 0.05^2 / 0.01 = 0.25 of east is the scale's
  state.p(kBias, kBias) = 0.04;
  state.p(kY, kBias) = state.p(kBias, kY) = 0.2;  // 0.2^2 / 0.04 = 1 of north is the wear's
  EXPECT_TRUE(bent_variance_m2(state).isApprox(Matrix2d(Vector2d(0.75, 1.0).asDiagonal()), 1e-12));
  state.p.row(kScale).setZero();  // a scale that is known
  state.p.col(kScale).setZero();
  EXPECT_TRUE(bent_variance_m2(state).isApprox(Matrix2d(Vector2d(1.0, 1.0).asDiagonal()), 1e-12));
}

TEST(PdrWalk, BeginsWhereFusionHearsOfItFirst) {
  PdrWalk walk;
  EXPECT_TRUE(walk.position_m().isZero());
  walk.take(10, {7.0, -3.0});
  EXPECT_TRUE(walk.position_m().isZero());
  walk.take(20, {7.5, -2.0});
  EXPECT_TRUE(walk.position_m().isApprox(Vector2d(0.5, 1.0)));
}

TEST(PdrWalk, DoesNotDependOnTheOrderOfArrival) {
  PdrWalk walk;
  walk.take(20, {3.0, 2.0});
  walk.take(30, {4.0, 2.0});
  walk.take(10, {1.0, 1.0});
  walk.take(15, {2.0, 5.0});
  EXPECT_TRUE(walk.position_m().isApprox(Vector2d(3.0, 1.0)));
}

TEST(PdrWalk, GoesOnFromWhereItWasWhenPdrStartsAgain) {
  PdrWalk walk;
  TimestampNs stamp_ns = 0;
  for (const double east_m : {0.0, 6.0, 0.0, 0.0, 1.0}) walk.take(++stamp_ns, {east_m, 0.0});
  EXPECT_TRUE(walk.position_m().isApprox(Vector2d(7.0, 0.0)));
}

TEST(PdrWalk, AFirstStepThatWasNoneIsNoNewStart) {
  PdrWalk walk;
  TimestampNs stamp_ns = 0;
  for (const double east_m : {0.0, 1.2, 0.0}) walk.take(++stamp_ns, {east_m, 0.0});
  EXPECT_TRUE(walk.position_m().isZero());
}

}  // namespace
}  // namespace vpdr::fusion
