#include <gtest/gtest.h>

#include "core/axis_map.hpp"
#include "imu_gateway/core/sample_correction.hpp"

namespace vpdr::imu_gateway {
namespace {

using V = Eigen::Vector3d;

calibration::BoardCalibration board() {
  calibration::BoardCalibration out;
  out.accelerometer.axes = parse_axis_map("-x,-y,-z", true).value();
  out.accelerometer.correction = {V(2, 1, 1).asDiagonal(), V(0.5, 0, 0)};
  out.gyroscope.correction.bias = V(0.1, 0, 0);
  out.gyroscope.bias_slope = V(0.01, 0, 0);
  out.gyroscope.temperature_c = 25.0;
  out.gyroscope.temperature_span_c = 10.0;
  out.magnetometer.correction.bias = V(0, 0, 100);
  return out;
}

ImuSample sample(const V& force, const V& rate) {
  ImuSample out;
  out.specific_force_mps2 = force;
  out.angular_velocity_radps = rate;
  return out;
}

TEST(SampleCorrection, AxesThenBiasThenMatrixThenMountByHand) {
  // The source has turned the board's y forward: body = (y, -x, z) of the board.
  const Eigen::Matrix3d mount = parse_axis_map("+y,-x,+z", false).value();
  const SampleCorrection correction(board(), mount);
  ImuSample imu = sample(mount * V(1, 2, 3), mount * V(0.3, 0.2, 0.1));
  correction.apply(imu, std::nullopt);
  // (1, 2, 3) -> signs (-1, -2, -3) -> bias (-1.5, -2, -3) -> scale (-3, -2, -3) -> body.
  EXPECT_TRUE(imu.specific_force_mps2.isApprox(V(-2, 3, -3)));
  EXPECT_TRUE(imu.angular_velocity_radps.isApprox(V(0.2, -0.2, 0.1)));
  MagSample mag;
  mag.field_ut = mount * V(10, 20, 130);
  correction.apply(mag);
  EXPECT_TRUE(mag.field_ut.isApprox(V(20, -10, 30)));
}

TEST(SampleCorrection, ACalibratedMountTakesTheSourcesPlace) {
  calibration::BoardCalibration worn;
  worn.mount.date = "2024-01-01T00:00:00Z";
  worn.mount.body_from_board = parse_axis_map("+z,+y,-x", false).value();
  const Eigen::Matrix3d source = parse_axis_map("+y,-x,+z", false).value();
  ImuSample imu = sample(source * V(1, 2, 3), V::Zero());
  SampleCorrection(worn, source).apply(imu, std::nullopt);
  EXPECT_TRUE(imu.specific_force_mps2.isApprox(V(3, 2, -1)));
  EXPECT_EQ(mount_of(worn, source), worn.mount.body_from_board);
  EXPECT_EQ(mount_of({}, source), source);
}

TEST(SampleCorrection, FollowsTheTemperatureAsFarAsItWasSeen) {
  const SampleCorrection correction(board(), Eigen::Matrix3d::Identity());
  const auto rate_at = [&](double celsius) {
    ImuSample imu = sample(V::Zero(), V(1, 0, 0));
    correction.apply(imu, celsius);
    return imu.angular_velocity_radps.x();
  };
  EXPECT_NEAR(rate_at(25.0), 0.9, 1e-12);
  EXPECT_NEAR(rate_at(28.0), 0.87, 1e-12);
  EXPECT_NEAR(rate_at(60.0), 0.85, 1e-12) << "the slope is known five degrees to either side";
}

TEST(SampleCorrection, LeavesAMissingGyroscopeAlone) {
  ImuSample imu = sample(V::Zero(), V::Zero());
  imu.has_angular_velocity = false;
  SampleCorrection(board(), Eigen::Matrix3d::Identity()).apply(imu, 30.0);
  EXPECT_TRUE(imu.angular_velocity_radps.isZero());
}

}  // namespace
}  // namespace vpdr::imu_gateway
