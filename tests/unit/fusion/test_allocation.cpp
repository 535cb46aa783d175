// The hot path takes no memory: every operator new is counted.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "fusion/core/fusion.hpp"

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

namespace vpdr::fusion {
namespace {

TEST(Allocation, ProcessAndLatestTakeNoMemory) {
  Fusion fusion;
  const std::size_t before = allocations;
  EXPECT_GT(before, 0U);  // the counter counts: construction takes the ring
  double walked = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const TimestampNs now = i * to_ns(0.05);
    PoseEstimate odometry;
    odometry.stamp_ns = now;
    fusion.process(odometry);
    fusion.process(HeadingEstimate{now, 0.1, 0.1, false});
    if (i % 10 == 0) {
      StepEvent step;
      step.stamp_ns = now - to_ns(0.2);  // late: what follows is applied again
      step.length_m = 0.7;
      step.length_sigma_m = 0.05;
      step.yaw_sigma_rad = 0.1;
      fusion.process(step);
    }
    fusion.process(HeadingRate{now - to_ns(0.3), now - to_ns(0.35), 0.0, 0.1});
    walked = fusion.latest()->distance_m;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_NEAR(walked, 70.0, 1e-9);
}

}  // namespace
}  // namespace vpdr::fusion
