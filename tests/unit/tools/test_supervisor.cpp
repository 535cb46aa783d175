// How a supervised walk begins and ends, with shell scripts for services.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace vpdr::tool
