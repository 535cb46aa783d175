// Correction and checks of a sample take no memory: every operator new is counted.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "imu_gateway/core/sample_correction.hpp"
#include "imu_gateway/core/startup_checks.hpp"
#include "support/counted_allocations.hpp"

namespace vpdr::imu_gateway {
namespace {

TEST(Allocation, OfASampleThroughCorrectionAndChecksIsNone) {
  calibration::BoardCalibration board;
  board.accelerometer.correction.bias = {0.1, 0.2, 0.3};
  const SampleCorrection correction(board, Eigen::Matrix3d::Identity());
  StartupChecks checks;
  const std::size_t before = vpdr::testing::allocations;
  for (int i = 0; i < 5000; ++i) {
    ImuSample imu;
    MagSample mag;
    imu.stamp_ns = mag.stamp_ns = TimestampNs{i} * 10'000'000;
    const double angle = 0.01 * i;
    imu.angular_velocity_radps = {0.0, 1.0, 0.0};
    imu.specific_force_mps2 = kGravityMps2 * Eigen::Vector3d(-std::sin(angle), 0, std::cos(angle));
    mag.field_ut = {30.0, 20.0, -20.0};
    correction.apply(imu, 25.0);
    correction.apply(mag);
    checks.see(imu);
    checks.see(mag);
  }
  EXPECT_EQ(vpdr::testing::allocations, before);
  EXPECT_TRUE(checks.findings().empty());
}

}  // namespace
}  // namespace vpdr::imu_gateway
