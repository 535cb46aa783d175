// The hot path takes no memory: every operator new is counted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "made_walk.hpp"
#include "pdr/core/pdr.hpp"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace vpdr::pdr {
namespace {

TEST(Allocation, ProcessTakesNoMemory) {
  made::Motion motion;
  motion.upward_mps2 = made::bounce(1.8);
  const made::Readings readings = made::read(motion, 20.0, 100.0);
  Pdr pdr;
  PdrOutput output;
  const std::size_t before = allocations;
  EXPECT_GT(before, 0U);  // the counter counts: the readings took some
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(pdr.step_count(), 20U);
}

}  // namespace
}  // namespace vpdr::pdr
