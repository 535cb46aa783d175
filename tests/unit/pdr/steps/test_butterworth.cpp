#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/steps/butterworth.hpp"

namespace vpdr::pdr {
namespace {

TEST(Butterworth, QuarterRateSecondOrderByHand) {
  // Cut-off at a quarter of the rate: the pre-warped frequency is tan(pi / 4) = 1, so
  // b = [1 2 1] / (2 + sqrt 2) and a1 = 0, a2 = (2 - sqrt 2) / (2 + sqrt 2). Step from 0 to 1:
  ButterworthLowPass filter(2, 25.0, 100.0);
  filter.filter(0.0);
  const double b0 = 1.0 / (2.0 + std::sqrt(2.0));                     // 0.2928932
  const double a2 = (2.0 - std::sqrt(2.0)) / (2.0 + std::sqrt(2.0));  // 0.1715729
  EXPECT_NEAR(filter.filter(1.0), b0, 1e-12);                         // 0.2928932
  EXPECT_NEAR(filter.filter(1.0), 3.0 * b0, 1e-12);                   // 0.8786797
  EXPECT_NEAR(filter.filter(1.0), 4.0 * b0 - a2 * b0, 1e-12);         // 1.1213203
}

TEST(Butterworth, PassesAConstantFromTheFirstSample) {
  for (const int order : {2, 4}) {
    ButterworthLowPass filter(order, 3.0, 50.0);
    for (int i = 0; i < 20; ++i) EXPECT_NEAR(filter.filter(9.81), 9.81, 1e-9);
  }
}

TEST(Butterworth, HasItsGainAtAnyRate) {
  for (const double rate : {20.0, 50.0, 100.0, 286.0, 1000.0}) {
    for (const int order : {2, 4}) {
      const ButterworthLowPass filter(order, 3.0, rate);
      EXPECT_NEAR(filter.gain(1e-6), 1.0, 1e-9);
      EXPECT_NEAR(filter.gain(3.0), std::sqrt(0.5), 1e-9) << rate;
      // The analogue prototype, 1 / sqrt(1 + (w / wc)^(2 n)), at the warped frequency.
      const double ratio = std::tan(kPi * 6.0 / rate) / std::tan(kPi * 3.0 / rate);
      EXPECT_NEAR(filter.gain(6.0), 1.0 / std::sqrt(1.0 + std::pow(ratio, 2 * order)), 1e-9);
    }
  }
}

TEST(Butterworth, DelaysASinusoidByWhatItSays) {
  for (const int order : {2, 4}) {
    const double rate = 200.0;
    const double frequency = 1.8;
    ButterworthLowPass filter(order, 3.0, rate);
    double error = 0.0;
    const double delay = filter.delay_s(frequency);
    const double gain = filter.gain(frequency);
    for (int i = 0; i < 4000; ++i) {
      const double t = i / rate;
      const double out = filter.filter(std::sin(2.0 * kPi * frequency * t));
      const double expected = gain * std::sin(2.0 * kPi * frequency * (t - delay));
      if (t > 5.0) error = std::max(error, std::abs(out - expected));
    }
    EXPECT_LT(error, 1e-6);
    EXPECT_GT(delay, 0.05);
    EXPECT_LT(delay, 0.2);
  }
}

TEST(Butterworth, KeepsItsLevelWhenTheRateChanges) {
  ButterworthLowPass filter(4, 3.0, 50.0);
  for (int i = 0; i < 100; ++i) filter.filter(5.0);
  filter.set_rate(200.0);
  EXPECT_NEAR(filter.gain(3.0), std::sqrt(0.5), 1e-9);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(filter.filter(5.0), 5.0, 1e-9);
}

TEST(Butterworth, StaysStableWithACutoffAboveTheRate) {
  ButterworthLowPass filter(4, 30.0, 20.0);
  double value = 0.0;
  for (int i = 0; i < 1000; ++i) value = filter.filter(i % 2 == 0 ? 1.0 : -1.0);
  EXPECT_TRUE(std::isfinite(value));
  EXPECT_LE(std::abs(value), 2.0);
}

}  // namespace
}  // namespace vpdr::pdr
