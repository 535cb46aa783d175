#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/coarse_levelling.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

TEST(CoarseLevelling, KnowsNothingBeforeTheFirstForce) {
  EXPECT_EQ(CoarseLevelling{}.tilt_sigma_rad(), kPi);
}

TEST(CoarseLevelling, SteadyForceIsUprightAndCertain) {
  CoarseLevelling levelling;
  // Tilted by 0.1 about y: g (sin 0.1, 0, cos 0.1).
  Vector3d force(kGravityMps2 * std::sin(0.1), 0.0, kGravityMps2 * std::cos(0.1));
  for (int i = 0; i < 10; ++i) force = levelling.add(0.04 * force, 0.04) * force;
  EXPECT_LT((force - Vector3d(0.0, 0.0, kGravityMps2)).norm(), 1e-9);
  EXPECT_NEAR(levelling.duration_s(), 0.4, 1e-12);
  EXPECT_LT(levelling.tilt_sigma_rad(), 1e-6);
}

TEST(CoarseLevelling, SpreadOfTheForceSaysHowFarTheMeanMayBeOff) {
  CoarseLevelling levelling;
  // +-3 m/s^2 along x about g up: mean square of the deviation 9, of each axis 3.
  for (int i = 0; i < 50; ++i) {
    const Vector3d force(i % 2 == 0 ? 3.0 : -3.0, 0.0, kGravityMps2);
    levelling.add(0.04 * force, 0.04);
  }
  EXPECT_NEAR(levelling.tilt_sigma_rad(), std::sqrt(3.0) / kGravityMps2, 0.01);
  levelling.restart();
  EXPECT_EQ(levelling.duration_s(), 0.0);
}

TEST(CoarseLevelling, TakesNoForceForNoDirection) {
  CoarseLevelling levelling;
  const Eigen::Quaterniond turn = levelling.add(Vector3d::Zero(), 0.04);
  EXPECT_EQ(turn.angularDistance(Eigen::Quaterniond::Identity()), 0.0);
  EXPECT_EQ(levelling.tilt_sigma_rad(), 0.0);
}

}  // namespace
}  // namespace vpdr::pdr
