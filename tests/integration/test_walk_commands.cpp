// The vpdr command as people type it: what it leaves, what it says, its exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/errors.hpp"
#include "evaluation/run_info.hpp"
#include "integration/harness.hpp"

namespace vpdr::testing_support {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class WalkCommands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("VPDR_INTERFACES", "127.0.0.1", 1);
    setenv("VPDR_DOMAIN", "174", 1);
  }

  /// Runs the command to its end; what it said is in said().
  ExitCode vpdr(const std::vector<std::string>& arguments) {
    tool::ChildProcess process("vpdr", fs::path(VPDR_BIN_DIR) / "vpdr", arguments,
                               folder() / "vpdr.log");
    const auto code = process.wait(kPatience);
    said_ = process.last_lines(50);
    return static_cast<ExitCode>(code.value_or(-1));
  }
  [[nodiscard]] const std::string& said() const { return said_; }
  [[nodiscard]] fs::path folder() const { return scratch_.path(); }
  fs::path simulated_walk() {
    const fs::path walk = folder() / "walk";
    EXPECT_EQ(vpdr({"simulate", "--out", walk, "--duration", "10", "--no-images"}), ExitCode::kOk)
        << said();
    return walk;
  }

 private:
  Scratch scratch_;
  std::string said_;
};

TEST_F(WalkCommands, AReportKeepsTheRecordingThatWasPlayed) {
  const fs::path walk = simulated_walk();
  const fs::path out = folder() / "up";
  ASSERT_EQ(vpdr({"up", walk, "--out", out, "--rate", "max"}), ExitCode::kOk) << said();
  ASSERT_EQ(vpdr({"report", out}), ExitCode::kOk) << said();
  EXPECT_EQ(evaluation::read_run_info(out).recording, walk);
  EXPECT_EQ(vpdr({"evaluate", out}), ExitCode::kOk) << said();
  EXPECT_THAT(said(), HasSubstr("position, from the start"));
}

TEST_F(WalkCommands, SimulateRefusesWhatItCannotTake) {
  const fs::path out = folder() / "none";
  EXPECT_EQ(vpdr({"simulate", "--out", out, "--duration", "4.9"}), ExitCode::kUsage);
  EXPECT_THAT(said(), HasSubstr("not in range 5"));
  EXPECT_EQ(vpdr({"simulate", "--out", out, "--seed", "-1"}), ExitCode::kUsage);
  EXPECT_EQ(vpdr({"up", "--simulate", "--out", out, "--seed", "-1"}), ExitCode::kUsage);
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(WalkCommands, WordsThatNoCommandKnowsAreNamed) {
  EXPECT_EQ(vpdr({"run", "walk", "--out", "out", "--config", "pdr.yaml"}), ExitCode::kUsage);
  EXPECT_THAT(said(), HasSubstr("run does not know --config; did you mean --config-dir?"));
  EXPECT_EQ(vpdr({"up", "--simulate", "--set", "serial.lines=[]"}), ExitCode::kConfiguration);
  EXPECT_THAT(said(), HasSubstr("unknown service 'serial'"));
  EXPECT_EQ(vpdr({"listen", "--domain", "400"}), ExitCode::kConfiguration);
  EXPECT_THAT(said(), HasSubstr("--domain 400: must be >= 0, <= 232"));
}

TEST_F(WalkCommands, WhatIsSetGoesOverWhatTheRecordingSays) {
  const fs::path walk = simulated_walk();
  std::ofstream(walk / "about.yaml") << "carry: head\nheight_m: 1.7\n";
  const auto steps_of = [this](const char* run) {
    std::ifstream file(folder() / run / "steps.csv");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string set = "pdr.carry=waist";
  EXPECT_EQ(vpdr({"run", walk, "--out", folder() / "told"}), ExitCode::kOk) << said();
  EXPECT_EQ(vpdr({"run", walk, "--out", folder() / "run", "--set", set}), ExitCode::kOk) << said();
  EXPECT_EQ(vpdr({"up", walk, "--out", folder() / "up", "--rate", "max", "--set", set}),
            ExitCode::kOk)
      << said();
  EXPECT_NE(steps_of("run"), steps_of("told"));
  EXPECT_EQ(steps_of("run"), steps_of("up"));
}

TEST_F(WalkCommands, ACarryThatNobodyKnowsIsSaid) {
  const fs::path walk = simulated_walk();
  std::ofstream(walk / "about.yaml") << "carry: trousers\n";
  EXPECT_EQ(vpdr({"run", walk, "--out", folder() / "run"}), ExitCode::kOk);
  EXPECT_THAT(said(), HasSubstr("carry 'trousers' names none of hand, pocket"));
}

TEST_F(WalkCommands, SimulateLeavesThePathItReadsAlone) {
  const fs::path walk = simulated_walk();
  const fs::path truth = walk / "groundtruth.csv";
  ASSERT_TRUE(fs::exists(truth));
  const auto size = fs::file_size(truth);
  for (const fs::path& path : {walk, truth}) {
    EXPECT_EQ(vpdr({"simulate", "--path", path, "--out", walk / ".." / "walk", "--no-images"}),
              ExitCode::kConfiguration);
    EXPECT_THAT(said(), HasSubstr("which is read; choose another folder"));
  }
  EXPECT_EQ(fs::file_size(truth), size);
  EXPECT_EQ(vpdr({"simulate", "--path", walk, "--out", folder() / "again", "--no-images"}),
            ExitCode::kOk);
  EXPECT_THAT(said(), HasSubstr(" 0 frames"));
}

}  // namespace
}  // namespace vpdr::testing_support
