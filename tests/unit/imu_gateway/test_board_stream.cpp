#include <gtest/gtest.h>

#include "imu_gateway/core/board_stream.hpp"
#include "imu_gateway/core/sensor_watch.hpp"
#include "imu_gateway/core/stream_watch.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr TimestampNs kStartNs = 1'700'000'000 * kNsPerSecond;
constexpr TimestampNs kMs = 1'000'000;

BoardReadings force_at(std::optional<TimestampNs> stamp_ns, double x) {
  BoardReadings readings;
  readings.board_stamp_ns = stamp_ns;
  readings.specific_force_mps2 = Eigen::Vector3d(x, 0, 0);
  return readings;
}

BoardReadings rate_at(std::optional<TimestampNs> stamp_ns, double x) {
  BoardReadings readings;
  readings.board_stamp_ns = stamp_ns;
  readings.angular_velocity_radps = Eigen::Vector3d(x, 0, 0);
  return readings;
}

TEST(BoardStream, TurnsEachSensorToTheBody) {
  BoardAxes axes;
  axes.accelerometer = -Eigen::Matrix3d::Identity();
  axes.mount << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  BoardStream stream(axes);
  BoardReadings readings = force_at(0, 1.0);
  readings.angular_velocity_radps = Eigen::Vector3d(1, 2, 3);
  readings.field_ut = Eigen::Vector3d(10, 20, 30);
  readings.pressure_pa = 1e5;
  std::vector<Reading> out;
  stream.accept(readings, kStartNs, out);
  ASSERT_EQ(out.size(), 3U);
  EXPECT_EQ(std::get<MagSample>(out[0]).field_ut, Eigen::Vector3d(20, -10, 30));
  EXPECT_EQ(std::get<PressureSample>(out[1]).pressure_pa, 1e5);
  EXPECT_EQ(std::get<ImuSample>(out[2]).specific_force_mps2, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(std::get<ImuSample>(out[2]).angular_velocity_radps, Eigen::Vector3d(2, -1, 3));
  EXPECT_EQ(std::get<ImuSample>(out[2]).stamp_ns, kStartNs);
}

TEST(BoardStream, JoinsAccelerometerAndGyroscopeOfDifferentRates) {
  // Force 10 t at 100 Hz, rate at 400 Hz a quarter of a period out of phase.
  BoardStream stream({});
  std::vector<Reading> out;
  for (int i = 0; i < 400; ++i) {
    const TimestampNs t = TimestampNs{i} * 2'500'000;
    stream.accept(rate_at(t + 600'000, 1e-3 * i), kStartNs + t + 600'000, out);
    if (i % 4 == 3) {
      const TimestampNs next = t + 2'500'000;
      stream.accept(force_at(next, 10.0 * to_seconds(next)), kStartNs + next, out);
    }
  }
  int paired = 0;
  for (const Reading& reading : out) {
    const auto& imu = std::get<ImuSample>(reading);
    if (!imu.has_angular_velocity) continue;
    const double t = to_seconds(imu.stamp_ns - kStartNs);
    EXPECT_NEAR(imu.specific_force_mps2.x(), 10.0 * t, 1e-5);
    ++paired;
  }
  // The rates before the second force have nothing before them to go by.
  EXPECT_GE(paired, 390);
  EXPECT_EQ(stream.health().unpaired + static_cast<std::uint64_t>(paired), 400U);
}

TEST(BoardStream, InventsNoForceAcrossAHole) {
  BoardStream stream({});
  std::vector<Reading> out;
  for (int i = 0; i < 100; ++i) {
    const TimestampNs t = i * 10 * kMs;
    stream.accept(rate_at(t, 1.0), kStartNs + t, out);
    if (i < 40 || i >= 60) stream.accept(force_at(t, 1.0), kStartNs + t, out);
  }
  EXPECT_EQ(stream.health().unpaired, 20U);
}

TEST(BoardStream, ABoardWithoutAGyroscopeIsReadAtOnce) {
  BoardStream stream({});
  std::vector<Reading> out;
  stream.accept(force_at(0, 9.8), kStartNs, out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_FALSE(std::get<ImuSample>(out[0]).has_angular_velocity);
}

TEST(BoardStream, CountsBurstsAndMissingSamples) {
  BoardStream stream({});
  std::vector<Reading> out;
  for (int i = 0; i < 300; ++i) {
    const bool held_back = i >= 200 && i < 210;
    const TimestampNs arrival_ns = kStartNs + (held_back ? 2100 * kMs : i * 10 * kMs);
    stream.accept(force_at(i * 10 * kMs, 9.8), arrival_ns, out);
  }
  EXPECT_EQ(out.size(), 300U);
  EXPECT_EQ(stream.health().bursts, 1U);

  BoardStream clockless({});
  for (int i = 0; i < 1000; ++i) {
    if (i >= 500 && i < 504) continue;
    clockless.accept(force_at(std::nullopt, 9.8), kStartNs + i * 10 * kMs, out);
  }
  EXPECT_EQ(clockless.health().missing, 4U);
}

TEST(StreamWatch, CountsHolesAgainstTheMedianPeriod) {
  StreamWatch watch;
  EXPECT_EQ(watch.rate_hz(), 0.0);
  int skipped = 0;
  for (int i = 0; i < 1000; ++i) {
    const bool hole = i == 300 || i == 600 || i == 601;
    if (hole) {
      ++skipped;
      continue;
    }
    watch.see(i * 5 * kMs + (i % 3) * kMs / 2);  // jitters by a tenth of the period
  }
  EXPECT_NEAR(watch.rate_hz(), 200.0, 25.0);
  EXPECT_EQ(watch.gaps(), 2U);
  EXPECT_EQ(watch.missing(), static_cast<std::uint64_t>(skipped));
}

TEST(SensorWatch, FlagsAnAxisThatRepeatsItself) {
  SensorWatch watch({});
  auto see = [&watch, i = 0](double y) mutable {
    ++i;
    watch.see(i * 10 * kMs, {0.01 * (i % 7), y, 0.1 * (i % 3)});
  };
  for (int i = 0; i < 500; ++i) see(i % 2);
  EXPECT_EQ(watch.stuck_axes(), "");
  for (int i = 0; i < 300; ++i) see(0.25);
  EXPECT_EQ(watch.stuck_axes(), "y");
  EXPECT_NEAR(static_cast<double>(watch.stuck()), 100.0, 2.0);  // after two seconds
  see(0.5);
  EXPECT_EQ(watch.stuck_axes(), "");
}

TEST(SensorWatch, FlagsTheEndOfTheRange) {
  SensorWatch watch({.least_full_scale = 15.0});
  for (int i = 0; i < 1000; ++i) {
    // A sensor of 2 g: peaks of 25 m/s^2 are cut at 19.61.
    const double x = std::clamp(25.0 * std::sin(0.05 * i), -19.61, 19.61);
    watch.see(i * 10 * kMs, {x, 0.01 * (i % 5), 9.8 + 0.01 * (i % 3)});
  }
  EXPECT_GT(watch.saturated(), 100U);
  SensorWatch whole({.least_full_scale = 15.0});
  for (int i = 0; i < 1000; ++i) {
    whole.see(i * 10 * kMs, {25.0 * std::sin(0.05 * i), 0.01 * (i % 5), 9.8 + 0.01 * (i % 3)});
  }
  EXPECT_EQ(whole.saturated(), 0U);
}

}  // namespace
}  // namespace vpdr::imu_gateway
