#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/errors.hpp"
#include "vpdr/configuration.hpp"

namespace vpdr::tool {
namespace {

using testing::HasSubstr;

std::string fault_of(const std::optional<std::filesystem::path>& folder,
                     const std::vector<std::string>& assignments) {
  try {
    read_configuration(folder, assignments);
  } catch (const ConfigurationFault& fault) {
    return fault.what();
  }
  return "no fault";
}

class ConfigDir : public testing::Test {
 protected:
  ConfigDir()
      : folder_(std::filesystem::temp_directory_path() /
                ("vpdr_configuration_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ConfigDir() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }
  std::filesystem::path folder_;
};

TEST_F(ConfigDir, CommandLineGoesOverFileOverDefault) {
  write("pdr.yaml", "pdr:\n  step:\n    min_interval_s: 0.4\n    cutoff_hz: 2.5\n");
  const Configuration c = read_configuration(folder_, {"pdr.step.min_interval_s=0.45"});
  EXPECT_EQ(c.cores.pdr.step.min_interval_s, 0.45);
  EXPECT_EQ(c.cores.pdr.step.cutoff_hz, 2.5);
  EXPECT_EQ(c.cores.fusion.history.horizon_s, fusion::FusionConfig{}.history.horizon_s);
  ASSERT_EQ(c.services.size(), 3U);
  EXPECT_THAT(c.services[0].config, HasSubstr("min_interval_s: 0.45"));
}

TEST_F(ConfigDir, FilesOfTheServicesHoldAsTheyAre) {
  write("vision.yaml", "vision:\n  recording: walk\n  service:\n    walker: ann\n");
  EXPECT_EQ(fault_of(folder_, {}), "no fault");
}

TEST_F(ConfigDir, MistakeNamesFileLineAndKey) {
  write("fusion.yaml", "fusion:\n  history:\n    horizon_s: -1\n");
  EXPECT_THAT(fault_of(folder_, {}), HasSubstr("fusion.yaml:3"));
  EXPECT_THAT(fault_of(folder_, {}), HasSubstr("fusion.history.horizon_s"));
}

TEST_F(ConfigDir, AFileThatNothingReadsIsNamed) {
  EXPECT_THAT(fault_of(folder_, {}), HasSubstr("holds none of imu_gateway.yaml, pdr.yaml"));
  write("prd.yaml", "pdr:\n  carry: waist\n");
  EXPECT_THAT(fault_of(folder_, {}), HasSubstr("nothing reads prd.yaml; did you mean pdr.yaml?"));
  std::filesystem::rename(folder_ / "prd.yaml", folder_ / "pdr.yml");
  EXPECT_THAT(fault_of(folder_, {}), HasSubstr("did you mean pdr.yaml?"));
  std::filesystem::rename(folder_ / "pdr.yml", folder_ / "pdr.yaml");
  write("board.yaml", "calibration: {}\n");
  EXPECT_EQ(fault_of(folder_, {}), "no fault") << "other files may lie beside";
}

TEST_F(ConfigDir, AnEmptyFileChangesNothing) {
  write("pdr.yaml", "");
  EXPECT_EQ(fault_of(folder_, {}), "no fault");
}

TEST(Configuration, AnAssignmentToNoServiceIsRefused) {
  EXPECT_NO_THROW(check_service_of("pdr.carry=waist", {"pdr", "fusion"}));
  EXPECT_THROW(check_service_of("carry=waist", {"pdr", "fusion"}), ConfigurationFault);
  EXPECT_THROW(check_service_of("serial.lines=[]", {"pdr", "fusion"}), ConfigurationFault);
}

TEST(Configuration, UnknownServiceOrFolderIsNamedWithARemedy) {
  EXPECT_THAT(fault_of({}, {"fusoin.history.horizon_s=3"}), HasSubstr("did you mean 'fusion'"));
  EXPECT_THAT(fault_of("/no/such/folder", {}), HasSubstr("no such folder"));
}

}  // namespace
}  // namespace vpdr::tool
