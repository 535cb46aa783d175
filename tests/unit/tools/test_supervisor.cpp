// How a supervised walk begins and ends, with shell scripts for services.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vpdr/supervisor/supervisor.hpp"

namespace vpdr::tool {
namespace {

using ::testing::HasSubstr;
using vpdr::testing::TemporaryFolder;

TEST(Supervisor, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "not a folder");
  try {
    const Supervisor supervisor(folder.path(), file / "logs");
    FAIL() << "it made a folder below a file";
  } catch (const FileFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("file/logs: cannot create the folder: Not a directory"));
    EXPECT_THAT(fault.what(), HasSubstr("--out"));
  }
}

/// Services of these names and scripts, run until all have ended.
class Services {
 public:
  Ending run(const std::map<std::string, std::string>& scripts, bool walking) {
    std::vector<ServicePlan> plans;
    for (const auto& [name, script] : scripts) {
      const auto program = folder_.write(name, "#!/bin/sh\n" + script + "\n");
      std::filesystem::permissions(program, std::filesystem::perms::owner_all);
      plans.push_back({name, {}});
    }
    return Supervisor(folder_.path(), folder_.path() / "logs").run(plans, [=] { return walking; });
  }
  [[nodiscard]] std::string log(const std::string& name) const {
    std::ifstream in(folder_.path() / "logs" / (name + ".log"));
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  TemporaryFolder folder_;
};

/// Ends by a signal alone.
constexpr const char* kWaits = "exec tail -f /dev/null";

TEST(Supervisor, AFaultBeforeTheWalkEndsAllAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  const Ending ending = Services().run(
      {{"imu_gateway", "echo no such port; exit 4"}, {"fusion", kWaits}, {"recorder", kWaits}},
      false);
  EXPECT_EQ(ending.code, ExitCode::kDevice);
  EXPECT_EQ(ending.failed, "imu_gateway ended with code 4");
  EXPECT_THAT(ending.log_tail, HasSubstr("no such port"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(7));
}

TEST(Supervisor, AFaultInTheWalkStopsItsSourceOnly) {
  Services services;
  const std::string begun = "until [ -s ${0%/*}/pid ]; do :; done; ";
  const Ending ending = services.run(
      {{"fusion", begun + "exit 3"},
       {"imu_gateway", std::string("echo $$ >${0%/*}/pid; ") + kWaits},
       {"recorder", begun + "while kill -0 $(cat ${0%/*}/pid); do :; done; echo saw it end"}},
      true);
  EXPECT_EQ(ending.failed, "fusion ended with code 3");
  EXPECT_THAT(services.log("recorder"), HasSubstr("saw it end"));
}

TEST(Supervisor, ADeathBySignalIsAnInternalError) {
  EXPECT_EQ(Services().run({{"pdr", "kill -9 $$"}}, true).failed,
            "pdr was killed by signal 9 (out of memory?)");
  const Ending ending = Services().run({{"pdr", "kill -6 $$"}}, true);
  EXPECT_EQ(ending.failed, "pdr was killed by signal 6 (Aborted)");
  EXPECT_EQ(ending.code, ExitCode::kInternal);
}

}  // namespace
}  // namespace vpdr::tool
