#pragma once
// One algorithm, two homes: `vpdr run` in one process, `vpdr up` in five.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "evaluation/run_directory.hpp"
#include "integration/harness.hpp"

namespace vpdr::testing_support {

/// Runs a walk both ways, on a domain of its own.
class OneAlgorithm : public testing::Test {
 protected:
  /// How much the two ways may differ: m, rad.
  struct Tolerance {
    double direction_rad = 1e-6;
    double position_m = 1e-6;
  };

  static void SetUpTestSuite() {
    setenv("VPDR_INTERFACES", "127.0.0.1", 1);
    setenv("VPDR_DOMAIN", "166", 1);
  }

  /// Runs the vpdr command to its end.
  void vpdr(const std::vector<std::string>& arguments) {
    tool::ChildProcess process("vpdr", std::filesystem::path(VPDR_BIN_DIR) / "vpdr", arguments,
                               folder() / "vpdr.log");
    const auto code = process.wait(300s);
    ASSERT_EQ(code, 0) << arguments.front() << "\n" << process.last_lines(20);
  }
  [[nodiscard]] std::filesystem::path folder() const { return scratch_.path(); }

  /// Steps and the last pose of both ways are the same, and all of the samples came through.
  void expect_same(const std::filesystem::path& walk, const Tolerance& tolerance) {
    vpdr({"run", walk, "--out", folder() / "run"});
    vpdr({"up", walk, "--out", folder() / "up", "--rate", "max"});
    const auto alone = evaluation::RunDirectory::read(folder() / "run");
    const auto five = evaluation::RunDirectory::read(folder() / "up");
    ASSERT_EQ(five.steps.size(), alone.steps.size());
    for (std::size_t i = 0; i < alone.steps.size(); ++i) {
      ASSERT_EQ(five.steps[i].stamp_ns, alone.steps[i].stamp_ns) << "step " << i;
      ASSERT_NEAR(five.steps[i].length_m, alone.steps[i].length_m, 1e-6) << "step " << i;
      const double turned = wrap_pi(five.steps[i].yaw_rad - alone.steps[i].yaw_rad);
      ASSERT_NEAR(turned, 0.0, tolerance.direction_rad) << "step " << i;
    }
    ASSERT_EQ(five.attitude.size(), alone.attitude.size());
    ASSERT_EQ(five.vision_heading.size(), alone.vision_heading.size());
    ASSERT_FALSE(alone.fused.empty());
    const auto& last = alone.fused.back();
    const auto& last_five = five.fused.back();
    EXPECT_EQ(last_five.stamp_ns, last.stamp_ns);
    EXPECT_LT((last_five.position_m - last.position_m).norm(), tolerance.position_m);
    EXPECT_LT(last_five.world_from_body.angularDistance(last.world_from_body),
              tolerance.direction_rad);
    ASSERT_EQ(five.info.latencies.size(), 1U);
    EXPECT_EQ(five.info.latencies.front().lost, 0U) << "samples without a fused pose";
  }

 private:
  Scratch scratch_;
};

}  // namespace vpdr::testing_support
