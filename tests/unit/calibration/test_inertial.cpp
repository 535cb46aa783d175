// Rests, accelerometer, gyroscope bias and Allan deviation against synthetic truth.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "calibration/accelerometer.hpp"
#include "calibration/allan_deviation.hpp"
#include "calibration/gyroscope.hpp"
#include "unit/calibration/synthetic_board.hpp"

namespace vpdr::calibration {
namespace {

using testing::attitudes;
using testing::pose;
using testing::ten_poses;
using testing::true_streams;
using V = Eigen::Vector3d;

TEST(Rests, AreFoundBetweenTheTurns) {
  const SensorStreams streams = true_streams(attitudes(ten_poses(), 2.0, 1.0));
  const std::vector<Rest> rests = find_rests(streams);
  ASSERT_EQ(rests.size(), 10U);
  EXPECT_NEAR(to_seconds(rests[1].begin_ns), 3.25, 0.3);
  EXPECT_GT(rests[1].duration_s(), 0.99);
  EXPECT_NEAR((rests[1].force_mps2 - V(kGravityMps2, 0, 0)).norm(), 0.0, 0.01);
  EXPECT_EQ(number_poses(rests).back(), 9U);
}

TEST(Rests, AreNotSeenInAHand) {
  auto path = attitudes(ten_poses(), 0.0, 2.0);
  EXPECT_TRUE(find_rests(true_streams(path)).empty());
}

TEST(Rests, OfOnePoseHaveOneNumber) {
  std::vector<Rest> rests(4);
  rests[0].force_mps2 = V(0, 0, 9.8);
  rests[1].force_mps2 = V(9.8, 0, 0);
  rests[2].force_mps2 = V(0.5, 0, 9.8);  // 2.9 degrees from the first
  rests[3].force_mps2 = V(0, 0, -9.8);
  EXPECT_EQ(number_poses(rests), (std::vector<std::size_t>{0, 1, 0, 2}));
}

/// Streams whose accelerometer reads with these faults.
SensorStreams faulty(const std::vector<Eigen::Quaterniond>& poses, const Eigen::Matrix3d& matrix,
                     const V& bias) {
  SensorStreams streams = true_streams(attitudes(poses, 2.0, 1.0));
  for (TimedVector& f : streams.force_mps2) f.value = matrix.inverse() * f.value + bias;
  return streams;
}

TEST(Accelerometer, FindsBiasScaleAndSkew) {
  Eigen::Matrix3d matrix;
  matrix << 1.02, 0.004, -0.003, 0.004, 0.985, 0.002, -0.003, 0.002, 1.01;
  const V bias(0.3, -0.2, 0.4);
  const SensorStreams streams = faulty(ten_poses(), matrix, bias);
  const auto found = calibrate_accelerometer(streams, find_rests(streams));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found.value().poses, 10U);
  EXPECT_LT((found.value().correction.matrix - matrix).norm(), 0.004);
  EXPECT_LT((found.value().correction.bias - bias).norm(), 0.02);
  EXPECT_GT(found.value().rms_before, 0.02);
  EXPECT_LT(found.value().rms, 0.001);
}

TEST(Accelerometer, SixSidesAreEnough) {
  auto six = ten_poses();
  six.resize(6);
  const SensorStreams streams =
      faulty(six, Eigen::Vector3d(1.02, 0.98, 1.0).asDiagonal(), V(0.1, 0, 0));
  const auto found = calibrate_accelerometer(streams, find_rests(streams));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(found.value().rms, 0.001);
}

TEST(Accelerometer, RefusesPoorCoverageAndSaysWhichWayToLieDown) {
  // All the poses in which z points up or level: what z reads downwards is not known.
  const SensorStreams streams = faulty({pose(V(0, 0, 1)), pose(V(1, 0, 0)), pose(V(-1, 0, 0)),
                                        pose(V(0, 1, 0)), pose(V(0, -1, 0)), pose(V(1, 1, 1))},
                                       Eigen::Matrix3d::Identity(), V::Zero());
  const auto found = calibrate_accelerometer(streams, find_rests(streams));
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("-z"), std::string::npos) << found.error().message;
}

TEST(Accelerometer, RefusesTwoPoses) {
  const SensorStreams streams =
      faulty({pose(V(0, 0, 1)), pose(V(1, 0, 0))}, Eigen::Matrix3d::Identity(), V::Zero());
  const auto found = calibrate_accelerometer(streams, find_rests(streams));
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("still: 2"), std::string::npos);
}

/// A minute and more at rest, the bias going with the temperature.
SensorStreams warming(double seconds, const V& bias, const V& slope, double celsius_per_s) {
  SensorStreams streams = true_streams(attitudes({pose(V(0, 0, 1))}, seconds, 0.0));
  for (TimedVector& rate : streams.rate_radps) {
    const double celsius = 25.0 + celsius_per_s * to_seconds(rate.stamp_ns);
    rate.value += bias + slope * (celsius - 25.0);
    streams.temperature_c.push_back({rate.stamp_ns, celsius});
  }
  return streams;
}

TEST(Gyroscope, FindsTheBiasAndItsTemperatureSlope) {
  const V bias(0.02, -0.01, 0.005);
  const V slope(1e-3, -5e-4, 0.0);
  const SensorStreams streams = warming(120.0, bias, slope, 0.05);
  const auto found = calibrate_gyroscope(streams, find_rests(streams));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT((found.value().at(25.0) - bias).norm(), 2e-4);
  EXPECT_LT((found.value().slope_radps_per_c - slope).norm(), 3e-5);
  EXPECT_NEAR(found.value().temperature_span_c, 5.75, 0.5);
  // What the temperature does not explain is the white noise: 1e-3 over 500 samples.
  EXPECT_NEAR(found.value().residual_radps.x(), 1e-3 / std::sqrt(500.0), 2e-5);
  EXPECT_GT(found.value().wander_radps.x(), 10.0 * found.value().residual_radps.x());
}

TEST(Gyroscope, TemperaturesMayComeLateAndSeldom) {
  const V slope(1e-3, -5e-4, 0.0);
  SensorStreams streams = warming(120.0, V(0.02, -0.01, 0.005), slope, 0.05);
  const TimestampNs first_ns = streams.temperature_c.front().stamp_ns + 12 * kNsPerSecond;
  TimestampNs next_ns = first_ns;
  std::erase_if(streams.temperature_c, [&](const TimedValue& t) {
    if (t.stamp_ns < next_ns) return true;
    next_ns += 8 * kNsPerSecond;
    return false;
  });
  ASSERT_LT(streams.temperature_c.size(), 16U);
  const auto found = calibrate_gyroscope(streams, find_rests(streams));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT((found.value().slope_radps_per_c - slope).norm(), 0.1 * slope.norm());
  EXPECT_LT(found.value().temperature_span_c, 6.0);
}

TEST(Gyroscope, MakesNoSlopeOfNoise) {
  const SensorStreams streams = warming(60.0, V(0.01, 0, 0), V::Zero(), 1e-4);
  const auto found = calibrate_gyroscope(streams, find_rests(streams));
  ASSERT_TRUE(found);
  EXPECT_LT(found.value().slope_radps_per_c.norm() * found.value().temperature_span_c, 1e-4);
}

TEST(Gyroscope, RefusesAShortRestAndRatesInDegrees) {
  const SensorStreams brief = warming(2.0, V::Zero(), V::Zero(), 0.0);
  const auto refused = calibrate_gyroscope(brief, find_rests(brief));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("minute"), std::string::npos);
  const SensorStreams degrees = warming(30.0, V(1.2, 0.4, -0.8), V::Zero(), 0.0);
  const auto implausible = calibrate_gyroscope(degrees, find_rests(degrees));
  ASSERT_FALSE(implausible);
  EXPECT_NE(implausible.error().message.find("degrees"), std::string::npos);
}

TEST(AllanDeviation, ByHand) {
  // A square wave of period 4 s, seen at 1 Hz: + + - - + + - - ... Means over 1 s differ from the
  // next by 0 and 2 in turn: variance 4 / 2 / 2 = 1. Means over 2 s are all +1, 0, -1, 0: of the
  // overlapping differences half are 2, half 0 -> the same; means over 4 s are all equal.
  std::vector<TimedVector> stream;
  for (int i = 0; i < 401; ++i) {
    const double value = (i + 3) % 4 < 2 ? 1.0 : -1.0;
    stream.push_back({i * kNsPerSecond, V(value, 0, 0)});
  }
  const auto found = allan_deviation(stream, 0, 1000 * kNsPerSecond);
  ASSERT_TRUE(found) << found.error().message;
  const auto& curve = found.value().curve;
  ASSERT_GE(curve.size(), 3U);
  EXPECT_NEAR(curve[0].tau_s, 1.0, 1e-9);
  EXPECT_NEAR(curve[0].deviation.x(), 1.0, 0.01);
  EXPECT_NEAR(curve[1].deviation.x(), 1.0, 0.01);
  EXPECT_NEAR(curve[2].deviation.x(), 0.0, 1e-9);
}

TEST(AllanDeviation, OfWhiteNoiseFallsWithTheRootOfTime) {
  const SensorStreams streams = true_streams(attitudes({pose(V(0, 0, 1))}, 300.0, 0.0));
  const auto found = allan_deviation(streams.rate_radps, 0, 400 * kNsPerSecond);
  ASSERT_TRUE(found);
  // 1e-3 rad/s at 100 Hz is 1e-4 rad/s/sqrt(Hz).
  EXPECT_NEAR(found.value().noise_density.y(), 1e-4, 5e-6);
  for (const AllanPoint& point : found.value().curve) {
    EXPECT_NEAR(point.deviation.z() * std::sqrt(point.tau_s), 1e-4, 4e-5) << point.tau_s;
  }
}

TEST(AllanDeviation, DoesNotMindUnevenStamps) {
  SensorStreams streams = true_streams(attitudes({pose(V(0, 0, 1))}, 120.0, 0.0));
  std::vector<TimedVector> uneven;
  for (std::size_t i = 0; i < streams.rate_radps.size(); ++i) {
    TimedVector sample = streams.rate_radps[i];
    sample.stamp_ns += (i % 3 == 0) ? 4'000'000 : 0;
    uneven.push_back(sample);
  }
  const auto even = allan_deviation(streams.rate_radps, 0, 200 * kNsPerSecond);
  const auto bursty = allan_deviation(uneven, 0, 200 * kNsPerSecond);
  ASSERT_TRUE(even);
  ASSERT_TRUE(bursty);
  EXPECT_NEAR(bursty.value().noise_density.x(), even.value().noise_density.x(), 2e-5);
}

TEST(AllanDeviation, RefusesAShortRest) {
  const SensorStreams streams = true_streams(attitudes({pose(V(0, 0, 1))}, 10.0, 0.0));
  EXPECT_FALSE(allan_deviation(streams.rate_radps, 0, 20 * kNsPerSecond));
}

}  // namespace
}  // namespace vpdr::calibration
