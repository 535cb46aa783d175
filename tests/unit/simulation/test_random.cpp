#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.hpp"

namespace vpdr::simulation {
namespace {

TEST(Random, KnownBits) {
  // SplitMix64's published first output for state 0.
  EXPECT_EQ(mix_bits(0), 0xe220a8397b1dcdafULL);
}

TEST(Random, SameSeedAndPurposeGiveTheSameStream) {
  Random a(7, "gait"), b(7, "gait"), other_seed(8, "gait"), other_purpose(7, "mag");
  const auto first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, other_seed.bits());
  EXPECT_NE(first, other_purpose.bits());
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
  Random random(1, "moments");
  const int count = 200'000;
  double uniform = 0.0, sum = 0.0, squares = 0.0, fourths = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    uniform += u;
    const double n = random.normal();
    sum += n;
    squares += n * n;
    fourths += n * n * n * n;
  }
  // Five standard errors each.
  EXPECT_NEAR(uniform / count, 0.5, 5 * 0.2887 / std::sqrt(count));
  EXPECT_NEAR(sum / count, 0.0, 5 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 1.0, 5 * std::sqrt(2.0 / count));
  EXPECT_NEAR(fourths / count, 3.0, 5 * std::sqrt(96.0 / count));
}

TEST(Random, IndexStaysBelowItsCount) {
  Random random(1, "index");
  int seen[3] = {0, 0, 0};
  for (int i = 0; i < 3000; ++i) ++seen[random.index(3)];
  for (const int count : seen) EXPECT_NEAR(count, 1000, 150);
}

TEST(SmoothNoise, HasUnitVarianceOverTheEnsembleAndIsSmooth) {
  Random random(3, "noise");
  double squares = 0.0;
  const int functions = 4000;
  for (int i = 0; i < functions; ++i) {
    const SmoothNoise noise(random, 2.0, 10.0);
    squares += noise(1.7) * noise(1.7);
    // The steepest possible slope: every term in step at the shortest period.
    EXPECT_LT(std::abs(noise(0.01) - noise(0.0)), 0.01 * 3.15 * std::sqrt(2.0 * 12.0));
  }
  EXPECT_NEAR(squares / functions, 1.0, 0.1);
}

TEST(SmoothNoise, SlopeIsTheDerivative) {
  Random random(4, "noise");
  const SmoothNoise noise(random, 2.0, 10.0);
  for (const double x : {0.0, 1.3, 7.7, 50.0}) {
    EXPECT_NEAR(noise.slope(x), (noise(x + 1e-4) - noise(x - 1e-4)) / 2e-4, 1e-6);
  }
}

}  // namespace
}  // namespace vpdr::simulation
