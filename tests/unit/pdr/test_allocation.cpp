// The hot path takes no memory: every operator new is counted.
#include <gtest/gtest.h>

#include "made_walk.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/support/counted_allocations.hpp"

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

}  // namespace
}  // namespace vpdr::pdr
