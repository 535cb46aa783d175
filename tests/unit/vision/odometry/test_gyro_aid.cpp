#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "vision/core/odometry/gyro_aid.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

TEST(GyroAid, LearnsTheBiasFromWhatTheCameraSaw) {
  const Vector3d bias(0.03, -0.02, 0.01);
  GyroAid aid;
  constexpr double kDt = 0.05, kSeen = 1e-3;
  const double first = aid.corrected(Eigen::Quaterniond::Identity(), kDt).sigma_rad;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond truth = exp_rotation({0.01, 0.02, -0.01});
    const GyroAid::Turn turn = aid.corrected(truth * exp_rotation(bias * kDt), kDt);
    // The camera's posterior: its own measurement weighted with the gyroscope's.
    const double gain =
        turn.sigma_rad * turn.sigma_rad / (turn.sigma_rad * turn.sigma_rad + kSeen * kSeen);
    const Vector3d correction = gain * log_rotation(turn.rotation.conjugate() * truth);
    aid.learn(turn, kDt, correction,
              (1.0 - gain) * turn.sigma_rad * turn.sigma_rad * Eigen::Matrix3d::Identity());
  }
  EXPECT_LT((aid.bias_radps() - bias).norm(), 2e-3);
  EXPECT_LT(aid.corrected(Eigen::Quaterniond::Identity(), kDt).sigma_rad, 0.5 * first);
}

}  // namespace
}  // namespace vpdr::vision
