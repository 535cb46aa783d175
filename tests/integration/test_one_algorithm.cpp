// One algorithm, three homes: the five processes and `vpdr run` give the same numbers, because
// filters run on sensor time.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/samples.hpp"
#include "evaluation/run_directory.hpp"
#include "integration/harness.hpp"

namespace vpdr::testing_support {
namespace {

constexpr double kTolerance = 1e-6;

class OneAlgorithm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("VPDR_INTERFACES", "127.0.0.1", 1);
    setenv("VPDR_DOMAIN", "160", 1);
  }

  /// Runs the vpdr command to its end.
  void vpdr(const std::vector<std::string>& arguments) {
    tool::ChildProcess process("vpdr", std::filesystem::path(VPDR_BIN_DIR) / "vpdr", arguments,
                               folder() / "vpdr.log");
    const auto code = process.wait(300s);
    ASSERT_EQ(code, 0) << arguments.front() << "\n" << process.last_lines(20);
  }
  [[nodiscard]] std::filesystem::path folder() const { return scratch_.path(); }

  void expect_same(const std::filesystem::path& walk) {
    vpdr({"run", walk, "--out", folder() / "run"});
    vpdr({"up", walk, "--out", folder() / "up", "--rate", "max"});
    const auto alone = evaluation::RunDirectory::read(folder() / "run");
    const auto five = evaluation::RunDirectory::read(folder() / "up");
    ASSERT_EQ(five.steps.size(), alone.steps.size());
    for (std::size_t i = 0; i < alone.steps.size(); ++i) {
      ASSERT_EQ(five.steps[i].stamp_ns, alone.steps[i].stamp_ns) << "step " << i;
      ASSERT_NEAR(five.steps[i].length_m, alone.steps[i].length_m, kTolerance) << "step " << i;
      ASSERT_NEAR(five.steps[i].yaw_rad, alone.steps[i].yaw_rad, kTolerance) << "step " << i;
    }
    ASSERT_EQ(five.attitude.size(), alone.attitude.size());
    ASSERT_EQ(five.vision_heading.size(), alone.vision_heading.size());
    ASSERT_FALSE(alone.fused.empty());
    const auto& last = alone.fused.back();
    const auto& last_five = five.fused.back();
    EXPECT_EQ(last_five.stamp_ns, last.stamp_ns);
    EXPECT_LT((last_five.position_m - last.position_m).norm(), kTolerance);
    EXPECT_LT(last_five.world_from_body.angularDistance(last.world_from_body), kTolerance);
    ASSERT_EQ(five.info.latencies.size(), 1U);
    EXPECT_EQ(five.info.latencies.front().lost, 0U) << "samples without a fused pose";
  }

 private:
  Scratch scratch_;
};

TEST_F(OneAlgorithm, SimulatedWalkWithCamera) {
  vpdr({"simulate", "--out", folder() / "walk", "--duration", "15", "--seed", "7"});
  expect_same(folder() / "walk");
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
  expect_same(walk);
}

}  // namespace
}  // namespace vpdr::testing_support
