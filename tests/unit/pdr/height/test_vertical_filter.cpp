#include <gtest/gtest.h>

#include <cmath>

#include "pdr/core/height/vertical_filter.hpp"

namespace vpdr::pdr {
namespace {

constexpr double kNothing = 1e12;  ///< variance of a reading that says nothing

/// Nobody climbs, no door opens.
VerticalConfig level_only() {
  VerticalConfig config;
  config.level_time_s = config.jump_every_s = 1e15;
  return config;
}

TEST(VerticalFilter, OnTheLevelTheWeatherTakesWhatThePressureDoes) {
  VerticalFilter filter(level_only());
  filter.start(0.0, 0.0, 0.0, 0.01);
  for (int i = 0; i < 600; ++i) filter.add(0.01 * i, 0.01, 0.5, false);
  // No model is ever out of the running, so a trace of a climb remains.
  EXPECT_NEAR(filter.height_m(), 0.0, 1e-3);
  EXPECT_NEAR(filter.height_variance_m2(), 0.0, 1e-3);
  EXPECT_NEAR(filter.speed_mps(), 0.0, 1e-5);
}

TEST(VerticalFilter, OneReadingByHand) {
  // Height 0 to 1 m; the first reading, 2 m, gives the weather w = 2 - h - g. What a later reading
  // of h + w + g says is of w and g alone: cov(h, h + w) = 1 - 1 = 0, so h stays as it is.
  VerticalConfig config = level_only();
  config.gust_sigma_m = 0.3;
  config.gust_time_s = 1e-3;
  config.weather_m_sqrt_s = 0.2;
  VerticalFilter filter(config);
  filter.start(0.0, 1.0, 2.0, 0.0);
  filter.add(3.0, 0.16, 4.0, false);
  EXPECT_NEAR(filter.height_m(), 0.0, 1e-4);
  EXPECT_NEAR(filter.height_variance_m2(), 1.0, 1e-4);
}

TEST(VerticalFilter, ModelsSwitchAtTheirRates) {
  // Nothing is read. Climbs begin at 1 / 120 s and end at 1 / 15 s: in balance (1 / 120) /
  // (1 / 120 + 1 / 15) = 1 / 9 of the time on the way up or down.
  VerticalConfig config;
  config.jump_every_s = 1e15;
  VerticalFilter filter(config);
  filter.start(0.0, 0.0, 0.0, 0.01);
  filter.add(0.0, kNothing, 0.5, true);
  EXPECT_NEAR(filter.climbing(), 1.0 - std::exp(-0.5 / 120.0), 1e-5);
  for (int i = 0; i < 1000; ++i) filter.add(0.0, kNothing, 0.1, true);
  EXPECT_NEAR(filter.climbing(), 1.0 / 9.0, 2e-3);
  EXPECT_NEAR(filter.height_m(), 0.0, 1e-6);  // up is as likely as down
}

TEST(VerticalFilter, ASilenceIsAsLongAsItsPieces) {
  VerticalFilter whole{VerticalConfig{}};
  VerticalFilter pieces{VerticalConfig{}};
  whole.start(0.0, 0.0, 0.0, 0.01);
  pieces.start(0.0, 0.0, 0.0, 0.01);
  whole.add(0.0, kNothing, 20.0, true);
  for (int i = 0; i < 20; ++i) pieces.add(0.0, kNothing, 1.0, true);
  EXPECT_NEAR(pieces.climbing(), whole.climbing(), 0.1 * whole.climbing());
  EXPECT_NEAR(pieces.height_variance_m2(), whole.height_variance_m2(),
              0.25 * whole.height_variance_m2());
}

TEST(VerticalFilter, ASteadyRiseIsAClimbAndAJumpIsNone) {
  VerticalFilter climber{VerticalConfig{}};
  VerticalFilter door{VerticalConfig{}};
  climber.start(0.0, 0.0, 0.0, 0.001);
  door.start(0.0, 0.0, 0.0, 0.001);
  for (int i = 0; i < 40; ++i) {
    climber.add(0.0, 0.001, 0.5, true);
    door.add(0.0, 0.001, 0.5, true);
  }
  for (int i = 1; i <= 20; ++i) {
    climber.add(0.15 * i, 0.001, 0.5, true);
    door.add(3.0, 0.001, 0.5, true);
  }
  EXPECT_GT(climber.climbing(), 0.8);
  EXPECT_NEAR(climber.speed_mps(), 0.3, 0.06);
  EXPECT_NEAR(climber.height_m(), 3.0, 0.4);
  EXPECT_LT(door.climbing(), 0.2);
  EXPECT_NEAR(door.height_m(), 0.0, 0.2);
}

}  // namespace
}  // namespace vpdr::pdr
