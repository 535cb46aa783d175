#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pdr/core/attitude/rest_detector.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0.0, 0.0, 9.81);

struct Board {
  RestDetector detector{RestConfig{}};
  std::mt19937 random{3};
  std::normal_distribution<double> normal{0.0, 1.0};

  void lie(double seconds, double rate_noise, double force_noise, const Vector3d& bias) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0); ++i) {
      const Vector3d n(normal(random), normal(random), normal(random));
      detector.add(bias + rate_noise * n, kUp + force_noise * n, 0.01);
    }
  }
};

TEST(RestDetector, KnowsRestAfterAWhileAndItsMeanRate) {
  Board board;
  const Vector3d bias(0.03, -0.02, 0.01);
  board.lie(1.2, 0.003, 0.03, bias);
  EXPECT_FALSE(board.detector.at_rest());
  board.lie(2.0, 0.003, 0.03, bias);
  EXPECT_TRUE(board.detector.at_rest());
  EXPECT_LT((board.detector.mean_rate_radps() - bias).norm(), 1e-3);
  EXPECT_TRUE(board.detector.take_new_rest_block());
  EXPECT_FALSE(board.detector.take_new_rest_block());
}

TEST(RestDetector, AMovementEndsRestAtOnce) {
  Board board;
  board.lie(3.0, 0.003, 0.03, Vector3d::Zero());
  ASSERT_TRUE(board.detector.at_rest());
  board.lie(0.3, 0.3, 1.0, Vector3d::Zero());
  EXPECT_FALSE(board.detector.at_rest());
}

TEST(RestDetector, ASteadyTurnIsNoBias) {
  Board board;
  board.lie(5.0, 0.003, 0.03, Vector3d(0.0, 0.0, 0.5));
  EXPECT_FALSE(board.detector.at_rest());
}

TEST(RestDetector, ASlowlyGrowingTurnIsNoRest) {
  RestDetector detector{RestConfig{}};
  for (int i = 0; i < 1000; ++i) {
    detector.add(Vector3d(0.0, 0.0, 1e-4 * i), kUp, 0.01);
    EXPECT_FALSE(detector.at_rest()) << i;
  }
}

TEST(RestDetector, ForgetsOnReset) {
  Board board;
  board.lie(3.0, 0.003, 0.03, Vector3d::Zero());
  board.detector.reset();
  EXPECT_FALSE(board.detector.at_rest());
}

}  // namespace
}  // namespace vpdr::pdr
