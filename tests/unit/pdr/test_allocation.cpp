// The hot path takes no memory: every operator new is counted.
#include <gtest/gtest.h>

#include "pdr/core/pdr.hpp"
#include "tests/support/counted_allocations.hpp"
#include "tests/unit/pdr/made_walk.hpp"
#include "tests/unit/pdr/steps/made_trunk.hpp"

namespace vpdr::pdr {
namespace {

TEST(Allocation, ProcessTakesNoMemory) {
  made::Motion motion;
  motion.upward_mps2 = made::bounce(1.8);
  const made::Readings readings = made::read(motion, 20.0, 100.0);
  Pdr pdr;
  PdrOutput output;
  const std::size_t before = vpdr::testing::allocations;
  EXPECT_GT(before, 0U);  // the counter counts: the readings took some
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(PressureSample{readings.imu[i].stamp_ns, 101000.0});
    pdr.process(readings.imu[i], output);
  }
  EXPECT_EQ(vpdr::testing::allocations, before);
  EXPECT_GT(pdr.step_count(), 20U);
}

TEST(Allocation, StepsOnTheTrunkTakeNoMemory) {
  const made::TrunkOfAWalker walker(made::ordinary_walk(30));
  StepDetector detector{{}, Carry::kWaist};
  int confirmed = 0;
  const std::size_t before = vpdr::testing::allocations;
  for (int i = 0; i < static_cast<int>(100.0 * walker.end_s()); ++i) {
    detector.add(to_ns(0.01 * i), walker.force_mps2(0.01 * i), Eigen::Vector3d::Zero());
    while (const auto step = detector.take()) confirmed += step->status == StepStatus::kConfirmed;
  }
  EXPECT_EQ(vpdr::testing::allocations, before);
  EXPECT_EQ(confirmed, 30);
}

}  // namespace
}  // namespace vpdr::pdr
