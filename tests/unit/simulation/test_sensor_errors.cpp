#include <gtest/gtest.h>

#include <cmath>

#include "simulation/sensor_errors.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

TEST(TriadSensor, WithoutErrorsReadsTheTruth) {
  TriadSensor sensor({}, 200.0, Random(1, "sensor"));
  const Vector3d truth(0.1, -9.7, 3.3);
  EXPECT_EQ(sensor.read(truth, 0.005), truth);
}

TEST(TriadSensor, NoiseDensityHoldsAtEveryRate) {
  for (const double rate : {20.0, 200.0}) {
    TriadErrors errors;
    errors.noise_density = 0.01;
    TriadSensor sensor(errors, rate, Random(1, "sensor"));
    const int count = 20'000;
    double squares = 0.0;
    for (int i = 0; i < count; ++i) {
      squares += sensor.read(Vector3d::Zero(), 1.0 / rate).squaredNorm() / (3.0 * count);
    }
    // White noise of density n sampled at rate f has the variance n^2 f.
    EXPECT_NEAR(squares / (1e-4 * rate), 1.0, 0.04);
  }
}

TEST(TriadSensor, BiasIsDrawnAndWalks) {
  TriadErrors errors;
  errors.turn_on_bias = 0.5;
  errors.bias_walk = 0.1;
  double start = 0.0, moved = 0.0;
  const int sensors = 600;
  for (int i = 0; i < sensors; ++i) {
    TriadSensor sensor(errors, 100.0, Random(static_cast<std::uint64_t>(i), "sensor"));
    const Vector3d first = sensor.read(Vector3d::Zero(), 0.0);
    Vector3d last = first;
    for (int k = 0; k < 400; ++k) last = sensor.read(Vector3d::Zero(), 0.01);
    start += first.squaredNorm() / (3.0 * sensors);
    moved += (last - first).squaredNorm() / (3.0 * sensors);
  }
  EXPECT_NEAR(std::sqrt(start), 0.5, 0.04);
  EXPECT_NEAR(std::sqrt(moved), 0.1 * std::sqrt(4.0), 0.015);  // grows with the root of time
}

TEST(TriadSensor, ReadingsAreMultiplesOfTheQuantum) {
  TriadErrors errors;
  errors.quantum = 0.25;
  TriadSensor sensor(errors, 100.0, Random(1, "sensor"));
  EXPECT_EQ(sensor.read({0.30, -0.4, 9.9}, 0.01), Vector3d(0.25, -0.5, 10.0));
}

TEST(TriadSensor, ScaleAndMisalignmentAreLinear) {
  TriadErrors errors;
  errors.scale_error = errors.misalignment_rad = 0.01;
  TriadSensor sensor(errors, 100.0, Random(1, "sensor"));
  const Vector3d once = sensor.read({1.0, 2.0, 3.0}, 0.01);
  const Vector3d twice = sensor.read({2.0, 4.0, 6.0}, 0.01);
  EXPECT_NEAR((twice - 2.0 * once).norm(), 0.0, 1e-12);
  EXPECT_GT((once - Vector3d(1.0, 2.0, 3.0)).norm(), 1e-4);
}

TEST(Barometer, PressureFallsTwelvePascalAMetre) {
  SensorErrors errors = SensorErrors::none();
  Barometer barometer(errors, Random(1, "baro"));
  EXPECT_DOUBLE_EQ(barometer.read(0.0, 0.04), 101325.0);
  // 101325 (1 - exp(-1 / 8434)) = 12.013 Pa
  EXPECT_NEAR(101325.0 - barometer.read(1.0, 0.04), 12.013, 0.001);
}

}  // namespace
}  // namespace vpdr::simulation
