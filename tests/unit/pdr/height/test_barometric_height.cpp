#include <gtest/gtest.h>

#include <cmath>

#include "pdr/core/height/barometric_height.hpp"
#include "tests/unit/pdr/height/made_air.hpp"

namespace vpdr::pdr {
namespace {

using made::Air;
using made::HeightProfile;

const HeightProfile kLevel = [](double) { return 0.0; };
/// When somebody walks.
using Walking = std::function<bool(double)>;
const Walking kAlways = [](double) { return true; };
constexpr double kStepPeriod = 0.55;

struct Climb {
  double largest_error_m = 0.0;
  double last_error_m = 0.0;
  double last_sigma_m = 0.0;
  int floor = 0;
  int changes = 0;
  std::vector<VerticalState> states;  ///< in their order, each once
  std::optional<FloorChange> last;
};

Climb follow(const std::vector<PressureSample>& samples, const HeightProfile& truth,
             const Walking& walking, const HeightConfig& config = {}) {
  BarometricHeight height(config);
  Climb climb;
  double next_step = 0.0;
  for (const PressureSample& sample : samples) {
    const double t = to_seconds(sample.stamp_ns - samples.front().stamp_ns);
    height.add(sample, walking(t), 0.0);
    for (; next_step <= t; next_step += kStepPeriod) {
      if (walking(next_step)) height.add_step();
    }
    climb.last_error_m = height.height_m(sample.stamp_ns) - truth(t);
    climb.largest_error_m = std::max(climb.largest_error_m, std::abs(climb.last_error_m));
    const VerticalState state = height.floors().state();
    if (climb.states.empty() || climb.states.back() != state) climb.states.push_back(state);
  }
  climb.last_sigma_m = std::sqrt(height.variance_m2(samples.back().stamp_ns));
  climb.floor = height.floors().floor();
  climb.changes = height.floors().changes();
  climb.last = height.floors().last_change();
  return climb;
}

bool has(const Climb& climb, VerticalState state) {
  return std::find(climb.states.begin(), climb.states.end(), state) != climb.states.end();
}

TEST(BarometricFormula, GivesTheStandardAtmosphere) {
  // ICAO Doc 7488: 95460.8 Pa at 500 m, 89874.6 Pa at 1000 m over 101325 Pa and 15 degrees.
  EXPECT_NEAR(barometric_height_m(95460.8, 101325.0, 288.15), 500.0, 0.05);
  EXPECT_NEAR(barometric_height_m(89874.6, 101325.0, 288.15), 1000.0, 0.05);
  EXPECT_EQ(barometric_height_m(97000.0, 97000.0, 293.15), 0.0);
  // Near the ground a pascal is R T / (g p) = 287.05 * 293.15 / (9.80665 * 101325) = 0.08469 m.
  EXPECT_NEAR(barometric_height_m(101324.0, 101325.0, 293.15), 0.08469, 1e-5);
  EXPECT_LT(barometric_height_m(101337.0, 101325.0, 293.15), -1.0);
}

TEST(BarometricHeight, KnowsNothingBeforeTheFirstReading) {
  BarometricHeight height;
  EXPECT_FALSE(height.known());
  EXPECT_EQ(height.climbing(), 0.0);
  height.add({to_ns(5.0), 99000.0}, false, 4.0);
  EXPECT_TRUE(height.known());
  EXPECT_EQ(height.height_m(to_ns(5.0)), 0.0);
  EXPECT_NEAR(height.variance_m2(to_ns(5.0)), 4.0, 1e-9);
}

TEST(BarometricHeight, ThreeFloorsOfStairs) {
  for (const int floors : {3, -3}) {
    const HeightProfile truth = made::stairs(30.0, floors);
    for (const double rate_hz : {1.0, 5.0, 25.0, 100.0}) {
      for (const double noise_pa : {0.1, 1.0, 2.0}) {
        const Air air{.noise_pa = noise_pa};
        const Climb climb = follow(made::read_pressure(truth, 110.0, rate_hz, air), truth, kAlways);
        EXPECT_LT(std::abs(climb.last_error_m), 0.5) << rate_hz << " Hz " << noise_pa << " Pa";
        EXPECT_EQ(climb.floor, floors) << rate_hz << " Hz " << noise_pa << " Pa";
        EXPECT_EQ(climb.changes, 1);
        ASSERT_TRUE(climb.last);
        EXPECT_TRUE(climb.last->by_stairs);
        EXPECT_NEAR(climb.last->gained_m, 3.0 * floors, 0.5);
        EXPECT_TRUE(has(climb, floors > 0 ? VerticalState::kStairsUp : VerticalState::kStairsDown));
        EXPECT_FALSE(has(climb, VerticalState::kLiftUp));
      }
    }
  }
}

TEST(BarometricHeight, ALiftLiftsWhoDoesNotStep) {
  for (const double rise_m : {9.0, -9.0, 3.2}) {
    const HeightProfile truth = made::lift(40.0, rise_m);
    const Walking walking = [](double t) { return t < 30.0 || t > 60.0; };
    for (const double rate_hz : {1.0, 25.0, 100.0}) {
      const Climb climb = follow(made::read_pressure(truth, 90.0, rate_hz), truth, walking);
      EXPECT_LT(std::abs(climb.last_error_m), 0.5) << rate_hz;
      EXPECT_EQ(climb.floor, std::lround(rise_m / 3.0)) << rate_hz;
      ASSERT_TRUE(climb.last);
      EXPECT_FALSE(climb.last->by_stairs);
      EXPECT_NEAR(to_seconds(climb.last->begin_ns), 41.0, 3.0);
      EXPECT_TRUE(has(climb, rise_m > 0.0 ? VerticalState::kLiftUp : VerticalState::kLiftDown));
    }
  }
}

TEST(BarometricHeight, EachFloorOfABuildingIsFound) {
  // Up by stairs, half a minute each on the first, second and third floor, down by lift.
  const HeightProfile truth = [](double t) {
    return made::stairs(30.0, 1)(t) + made::stairs(80.0, 1)(t) + made::stairs(130.0, 1)(t) +
           made::lift(190.0, -9.0)(t);
  };
  const Walking walking = [](double t) { return t < 180.0 || t > 210.0; };
  const Climb climb = follow(made::read_pressure(truth, 240.0, 25.0), truth, walking);
  EXPECT_EQ(climb.changes, 4);
  EXPECT_EQ(climb.floor, 0);
  EXPECT_LT(std::abs(climb.last_error_m), 0.5);
  ASSERT_TRUE(climb.last);
  EXPECT_EQ(climb.last->floors, -3);
}

TEST(BarometricHeight, TenMinutesOfWeatherAndDoorsAreNoFloor) {
  for (const double rate_hz : {1.0, 10.0, 50.0}) {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
      const Air air{.noise_pa = 2.0, .door_every_s = 20.0, .seed = seed};
      const Climb climb = follow(made::read_pressure(kLevel, 600.0, rate_hz, air), kLevel, kAlways);
      EXPECT_EQ(climb.changes, 0) << rate_hz << " " << seed;
      EXPECT_EQ(climb.floor, 0);
      EXPECT_LT(std::abs(climb.last_error_m), 0.5) << rate_hz << " " << seed;
    }
  }
}

TEST(BarometricHeight, NoiseOfFivePascalIsSmoothedAway) {
  const HeightProfile truth = made::stairs(40.0, 3);
  for (const double rate_hz : {5.0, 25.0, 100.0}) {
    const Air air{.noise_pa = 5.0};
    const Climb climb = follow(made::read_pressure(truth, 120.0, rate_hz, air), truth, kAlways);
    EXPECT_LT(std::abs(climb.last_error_m), 0.5) << rate_hz;
    EXPECT_EQ(climb.floor, 3) << rate_hz;
  }
}

TEST(BarometricHeight, ItsSigmaIsHonest) {
  const HeightProfile truth = made::stairs(30.0, 3);
  double nees = 0.0;
  constexpr unsigned kWalks = 40;
  for (unsigned seed = 1; seed <= kWalks; ++seed) {
    // Weather that wanders as the filter has it: 0.04 m per sqrt(s) is 0.47 Pa.
    std::mt19937 random(1000 + seed);
    std::normal_distribution<double> normal(0.0, 0.47 * std::sqrt(0.1));
    std::vector<PressureSample> samples =
        made::read_pressure(truth, 110.0, 10.0, Air{.noise_pa = 2.0, .seed = seed});
    double weather = 0.0;
    for (PressureSample& sample : samples) sample.pressure_pa += weather += normal(random);
    const Climb climb = follow(samples, truth, kAlways);
    nees += climb.last_error_m * climb.last_error_m / (climb.last_sigma_m * climb.last_sigma_m);
  }
  // Chi-squared with 40 degrees of freedom over 40: 0.61 to 1.48 in 95 % of cases. The made air has
  // no gusts, of which the filter must allow for some, so it may be less.
  EXPECT_GT(nees / kWalks, 0.3);
  EXPECT_LT(nees / kWalks, 1.48);
}

TEST(BarometricHeight, ASilentBarometerIsNotBelieved) {
  const HeightProfile truth = made::lift(30.0, 6.0);
  std::vector<PressureSample> samples = made::read_pressure(truth, 60.0, 10.0);
  std::erase_if(samples, [](const PressureSample& s) {
    return s.stamp_ns > to_ns(28.0) && s.stamp_ns < to_ns(45.0);
  });
  BarometricHeight height;
  double before = 0.0;
  for (const PressureSample& sample : samples) {
    if (sample.stamp_ns >= to_ns(45.0) && before == 0.0) {
      before = height.variance_m2(to_ns(28.0));
      EXPECT_GT(height.variance_m2(to_ns(44.0)), before + 2.0);
      EXPECT_NEAR(height.height_m(to_ns(44.0)), 0.0, 0.3);
    }
    height.add(sample, false, 0.0);
  }
  EXPECT_NEAR(height.height_m(samples.back().stamp_ns), 6.0, 0.5);
}

TEST(BarometricHeight, TheClockDoesNotMatter) {
  const HeightProfile truth = made::stairs(30.0, 2);
  const TimestampNs late = 1'700'000'000'000'000'000;
  const Climb a = follow(made::read_pressure(truth, 90.0, 10.0), truth, kAlways);
  const Climb b = follow(made::read_pressure(truth, 90.0, 10.0, {}, late), truth, kAlways);
  EXPECT_EQ(a.last_error_m, b.last_error_m);
  EXPECT_EQ(a.last_sigma_m, b.last_sigma_m);
  EXPECT_EQ(a.states, b.states);
}

TEST(BarometricHeight, AFirstStampInTheFutureDoesNotBlockIt) {
  const HeightProfile truth = made::stairs(30.0, 1);
  std::vector<PressureSample> samples = made::read_pressure(truth, 60.0, 10.0);
  samples.front().stamp_ns += to_ns(1e6);
  BarometricHeight height;
  for (const PressureSample& sample : samples) height.add(sample, true, 0.0);
  EXPECT_NEAR(height.height_m(samples.back().stamp_ns), 3.0, 0.5);
  EXPECT_EQ(height.floors().floor(), 1);
}

TEST(BarometricHeight, AWrongFirstReadingIsForgotten) {
  const HeightProfile truth = made::stairs(30.0, 1);
  const std::vector<PressureSample> right = made::read_pressure(truth, 60.0, 10.0);
  const Climb expected = follow(right, truth, kAlways);
  for (const double wrong_pa : {99000.0, 65000.0}) {
    std::vector<PressureSample> samples = right;
    samples.front().pressure_pa = wrong_pa;
    const Climb climb = follow(samples, truth, kAlways);
    EXPECT_LT(climb.largest_error_m, expected.largest_error_m + 0.3) << wrong_pa;
    EXPECT_EQ(climb.floor, 1) << wrong_pa;
  }
}

TEST(BarometricHeight, ThePressureOfTheDayDoesNotMatter) {
  const HeightProfile truth = made::stairs(30.0, 2);
  const Air low{.ground_pa = 90000.0, .noise_pa = 0.0, .drift_pa_per_hour = 0.0};
  const Air high{.ground_pa = 104000.0, .noise_pa = 0.0, .drift_pa_per_hour = 0.0};
  const Climb a = follow(made::read_pressure(truth, 90.0, 10.0, low), truth, kAlways);
  const Climb b = follow(made::read_pressure(truth, 90.0, 10.0, high), truth, kAlways);
  EXPECT_NEAR(a.last_error_m, b.last_error_m, 1e-6);
  EXPECT_EQ(a.states, b.states);
}

TEST(BarometricHeight, TheRateHardlyMatters) {
  const HeightProfile truth = made::stairs(30.0, 2);
  for (const double rate_hz : {1.0, 4.0, 25.0, 100.0}) {
    const Climb climb = follow(made::read_pressure(truth, 90.0, rate_hz), truth, kAlways);
    EXPECT_LT(std::abs(climb.last_error_m), 0.35) << rate_hz;
    EXPECT_LT(climb.largest_error_m, 1.3) << rate_hz;
  }
}

}  // namespace
}  // namespace vpdr::pdr
