#include <gtest/gtest.h>

#include <cmath>

#include "simulation/render/box_filter.hpp"

namespace vpdr::simulation {
namespace {

TEST(BoxFilter, CoverageIsTheSharedLength) {
  EXPECT_FLOAT_EQ(coverage(Footprint(1.0F, 0.5F), {0.0F, 1.0F}), 0.5F);
  EXPECT_FLOAT_EQ(coverage(Footprint(1.0F, 4.0F), {0.5F, 1.5F}), 0.25F);
  EXPECT_FLOAT_EQ(coverage(Footprint(0.5F, 0.1F), {0.0F, 1.0F}), 1.0F);
  EXPECT_FLOAT_EQ(coverage(Footprint(3.0F, 0.1F), {0.0F, 1.0F}), 0.0F);
}

TEST(BoxFilter, LinesOnAGridAverageOutFarAway) {
  // Lines 0.02 wide every 0.6: one thirtieth of a wide footprint, all of one on a line.
  EXPECT_NEAR(line_coverage(Footprint(123.4F, 60.0F), 0.3F, 0.6F, 0.02F), 1.0F / 30.0F, 1e-4F);
  EXPECT_NEAR(line_coverage(Footprint(0.9F, 0.01F), 0.3F, 0.6F, 0.02F), 1.0F, 1e-4F);
  EXPECT_NEAR(line_coverage(Footprint(0.6F, 0.1F), 0.3F, 0.6F, 0.02F), 0.0F, 1e-4F);
  EXPECT_NEAR(line_coverage(Footprint(-0.3F, 0.04F), 0.3F, 0.6F, 0.02F), 0.5F, 1e-4F);
  EXPECT_EQ(whole_below(-0.5F), -1);
  EXPECT_EQ(whole_below(2.0F), 2);
}

TEST(TileMap, AveragesExactly) {
  // 1 2
  // 3 4   (rows from below), tiles of 0.5 from (10, 20)
  const TileMap map(10.0F, 20.0F, 0.5F, 2, {3.0F, 4.0F, 1.0F, 2.0F});
  EXPECT_NEAR(map.average({10.25F, 0.1F}, {20.25F, 0.1F}), 3.0F, 1e-4F);
  EXPECT_NEAR(map.average({10.5F, 1.0F}, {20.5F, 1.0F}), 2.5F, 1e-4F);
  EXPECT_NEAR(map.average({10.5F, 0.2F}, {20.25F, 0.2F}), 3.5F, 1e-4F);
  // Half of it outside, where there is nothing.
  EXPECT_NEAR(map.average({11.0F, 1.0F}, {20.25F, 0.2F}), 2.0F, 1e-4F);
}

TEST(NoiseTexture, HasNoMeanAndFadesWithTheFootprint) {
  const NoiseTexture noise(Random(1, "noise"));
  const auto spread = [&](float footprint) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double value =
          noise.at(0.37F * static_cast<float>(i), -0.11F * static_cast<float>(i), footprint);
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(sum / 4000, 0.0, 0.15);
    return std::sqrt(squares / 4000);
  };
  const double near = spread(0.001F), middle = spread(0.1F), far = spread(2.0F);
  EXPECT_GT(near, 0.4);
  EXPECT_LT(near, 1.5);
  EXPECT_LT(middle, near);
  EXPECT_LT(far, 0.6 * near);
}

TEST(NoiseTexture, IsContinuousAcrossZeroAndItsSeam) {
  const NoiseTexture noise(Random(1, "noise"));
  for (const float seam : {0.0F, 4.096F, -4.096F}) {
    EXPECT_NEAR(noise.at(seam - 1e-5F, 0.7F, 0.01F), noise.at(seam + 1e-5F, 0.7F, 0.01F), 0.02F);
  }
}

}  // namespace
}  // namespace vpdr::simulation
