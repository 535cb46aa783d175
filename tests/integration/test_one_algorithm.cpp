// One algorithm, three homes: the five processes and `vpdr run` give the same numbers, because
// filters run on sensor time.
#include <gtest/gtest.h>

#include <cstdlib>

#include "integration/one_algorithm.hpp"

namespace vpdr::testing_support {
namespace {

TEST_F(OneAlgorithm, SimulatedWalkWithCamera) {
  vpdr({"simulate", "--out", folder() / "walk", "--duration", "15", "--seed", "7"});
  expect_same(folder() / "walk", {});
  const auto run = evaluation::RunDirectory::read(folder() / "run");
  EXPECT_GT(run.steps.size(), 5U);
  EXPECT_GT(run.vision_heading.size(), 100U);
}

TEST_F(OneAlgorithm, RecordedWalkWithoutCamera) {
  const char* data = std::getenv("VPDR_DATA");
  const std::filesystem::path root =
      data != nullptr ? data : std::filesystem::path(VPDR_SOURCE_DIR) / "../shared/data";
  const auto walk = root / "walks/ilc20/site1_B1_5dda257f9191710006b572b5";
  if (!std::filesystem::exists(walk)) GTEST_SKIP() << "skipped: no data at " << walk;
  expect_same(walk, {});
}

}  // namespace
}  // namespace vpdr::testing_support
