#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "vision/core/calibration/camera_imu.hpp"

namespace vpdr::vision {
namespace {

constexpr double kShift = 0.0237;
const Eigen::Vector3d kBias(0.01, -0.02, 0.015);

Eigen::Matrix3d true_rotation() {
  return (exp_rotation({0.05, -0.03, 0.02}) *
          Eigen::Quaterniond((Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished()))
      .toRotationMatrix();
}

// Body rate of a hand that waves about three axes at different frequencies.
Eigen::Vector3d rate(double t, bool one_axis) {
  if (one_axis) return {0.0, 0.0, 1.2 * std::sin(2.6 * t)};
  return {1.0 * std::sin(3.1 * t), 0.9 * std::sin(2.3 * t + 1.0), 1.2 * std::sin(1.7 * t + 2.0)};
}

struct Wave {
  std::vector<ImuSample> imu;
  std::vector<VisualTurn> turns;
};

// Half a minute: 200 Hz inertial samples, 20 frames a second whose clock is kShift behind.
Wave wave(double noise_rad, unsigned seed, bool one_axis = false, double bad_share = 0.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto noise = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(random), sigma * normal(random), sigma * normal(random));
  };
  Wave out;
  std::vector<Eigen::Quaterniond> attitude{Eigen::Quaterniond::Identity()};
  constexpr double kFine = 1e-3;
  for (int i = 0; i < 30'000; ++i) {
    attitude.push_back(attitude.back() * exp_rotation(rate((i + 0.5) * kFine, one_axis) * kFine));
  }
  for (int i = 0; i < 6000; ++i) {
    ImuSample s;
    s.stamp_ns = to_ns(i * 0.005);
    s.angular_velocity_radps = rate(i * 0.005, one_axis) + kBias + noise(2e-3);
    s.specific_force_mps2 = {0.0, 0.0, 9.81};
    out.imu.push_back(s);
  }
  const auto at = [&](double t) {
    const double exact = t / kFine;
    const auto i = static_cast<std::size_t>(exact);
    return attitude[i].slerp(exact - static_cast<double>(i), attitude[i + 1]);
  };
  for (double t = 1.0; t < 28.0; t += 0.05) {
    const Eigen::Quaterniond turn = at(t).conjugate() * at(t + 0.05);
    VisualTurn v;
    v.start_ns = to_ns(t - kShift);
    v.end_ns = to_ns(t + 0.05 - kShift);
    v.rotation_rad = true_rotation().transpose() * log_rotation(turn) + noise(noise_rad);
    if (uniform(random) < bad_share) v.rotation_rad = noise(0.3);
    out.turns.push_back(v);
  }
  return out;
}

double angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

TEST(CameraImu, ExactTurnsGiveTheExactMounting) {
  const Wave w = wave(0.0, 1);
  const auto c = align_camera_imu(w.turns, w.imu, {});
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_LT(to_degrees(angle(c.value().imu_from_camera, true_rotation())), 0.02);
  EXPECT_NEAR(c.value().timeshift_s, kShift, 2e-4);
  EXPECT_TRUE(c.value().gyro_bias_radps.isApprox(kBias, 0.05));
}

TEST(CameraImu, SigmaIsHonestAndBadFramesAreSetAside) {
  double rotation = 0.0;
  double shift = 0.0;
  constexpr int kWaves = 12;
  for (unsigned seed = 1; seed <= kWaves; ++seed) {
    const Wave w = wave(to_radians(0.15), seed, false, 0.1);
    const auto result = align_camera_imu(w.turns, w.imu, {});
    ASSERT_TRUE(result) << result.error().message;
    const CameraImuCalibration& c = result.value();
    EXPECT_LT(to_degrees(angle(c.imu_from_camera, true_rotation())), 0.6);
    EXPECT_NEAR(c.timeshift_s, kShift, 2e-3);
    EXPECT_GT(c.outliers, 25U);
    rotation += std::pow(angle(c.imu_from_camera, true_rotation()), 2) /
                c.rotation_sigma_rad.squaredNorm() / kWaves;
    shift += std::pow((c.timeshift_s - kShift) / c.timeshift_sigma_s, 2) / kWaves;
  }
  EXPECT_GT(std::sqrt(rotation), 0.4);
  EXPECT_LT(std::sqrt(rotation), 1.8);
  EXPECT_GT(std::sqrt(shift), 0.4);
  EXPECT_LT(std::sqrt(shift), 1.8);
}

TEST(CameraImu, RefusesWhatCannotTell) {
  const Wave one = wave(to_radians(0.1), 1, true);
  const auto single = align_camera_imu(one.turns, one.imu, {});
  ASSERT_FALSE(single);
  EXPECT_NE(single.error().message.find("one axis"), std::string::npos);
  Wave other = wave(to_radians(0.1), 1);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.05);
  for (VisualTurn& t : other.turns) {
    t.rotation_rad = {normal(random), normal(random), normal(random)};
  }
  const auto stranger = align_camera_imu(other.turns, other.imu, {});
  ASSERT_FALSE(stranger);
  EXPECT_NE(stranger.error().message.find("do not turn alike"), std::string::npos);
  EXPECT_FALSE(align_camera_imu({}, other.imu, {}));
  EXPECT_FALSE(align_camera_imu(other.turns, {}, {}));
}

}  // namespace
}  // namespace vpdr::vision
