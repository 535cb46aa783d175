#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "dataset/about.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::HasSubstr;

class AboutFile : public ::testing::Test {
 protected:
  About read(std::string_view text) { return read_about(folder_.write("about.yaml", text)); }
  std::string fault(std::string_view text) {
    try {
      read(text);
    } catch (const FileFault& fault) {
      return fault.what();
    }
    return "no fault";
  }
  testing::TemporaryFolder folder_;
};

TEST_F(AboutFile, ReadsWhatItKnowsAndLeavesTheRest) {
  const About about = read(
      "dataset: d\ntrial: t\ncarry: waist (lower back)\nheight_cm: 159\ndeclination_deg: 1.9\n"
      "true_steps: 257\nmagnetic_disturbance: true\nlicence: MIT\nwaypoints: 12\n");
  EXPECT_EQ(about.carry, "waist (lower back)");
  EXPECT_DOUBLE_EQ(*about.height_m, 1.59);
  EXPECT_DOUBLE_EQ(about.declination_rad, to_radians(1.9));
  EXPECT_DOUBLE_EQ(*about.true_steps, 257.0);
  EXPECT_TRUE(*about.magnetic_disturbance);
  EXPECT_TRUE(about.mount.isIdentity());
}

TEST_F(AboutFile, MovesReferenceFaultsToTheRecordingsClock) {
  // The reference's clock shows 40 s when the recording's shows 43.11 s.
  const About about = read("reference_faults_mocap_s: [[40, 52.6]]\nmocap_minus_phone_s: -3.11\n");
  ASSERT_EQ(about.reference_faults.size(), 1U);
  EXPECT_EQ(about.reference_faults[0].begin_ns, 43'110'000'000);
  EXPECT_EQ(about.reference_faults[0].end_ns, 55'710'000'000);
}

TEST_F(AboutFile, AFlatPhoneLooksAlongItsY) {
  const About about = read("carry: \"hand, flat in front of the body\"\n");
  EXPECT_TRUE((about.mount * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((about.mount * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE((about.mount * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY()));
}

TEST_F(AboutFile, AMountGivenGoesBeforeTheCarryText) {
  const About about = read("carry: hand, flat\nmount: {forward: \"-z\", up: \"+x\"}\n");
  EXPECT_TRUE((about.mount * -Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((about.mount * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitZ()));
  EXPECT_DOUBLE_EQ(about.mount.determinant(), 1.0);
}

TEST_F(AboutFile, NamesThePlaceOfAWrongValue) {
  EXPECT_THAT(fault("dataset: d\ndeclination_deg: east\n"),
              HasSubstr("about.yaml:2:18: declination_deg: must be a number; correct"));
  EXPECT_THAT(fault("declination_deg: .nan\n"), HasSubstr("must be finite"));
  EXPECT_THAT(fault("height_cm: 1.59\n"), HasSubstr("about.yaml:1:12: height: must be a person's"));
  EXPECT_THAT(fault("true_steps: -3\n"),
              HasSubstr("about.yaml:1:13: true_steps: must be 0 or more"));
  EXPECT_THAT(fault("mount: {forward: \"+y\", up: \"-y\"}\n"), HasSubstr("two different ones"));
  EXPECT_THAT(fault("reference_faults_s: [[5]]\n"), HasSubstr("[begin, end] in seconds"));
  EXPECT_THAT(fault("a: [1\n"), HasSubstr("YAML"));
}

TEST(MountFromAxes, EveryPairIsARotation) {
  const std::array<const char*, 6> names = {"+x", "-x", "+y", "-y", "+z", "-z"};
  int rotations = 0;
  for (const char* forward : names) {
    for (const char* up : names) {
      const auto mount = mount_from_axes(forward, up);
      if (!mount) continue;
      ++rotations;
      EXPECT_TRUE((*mount * mount->transpose()).isIdentity());
      EXPECT_DOUBLE_EQ(mount->determinant(), 1.0);
    }
  }
  EXPECT_EQ(rotations, 24);
  EXPECT_FALSE(mount_from_axes("forward", "+z"));
  EXPECT_FALSE(mount_from_axes("", ""));
}

}  // namespace
}  // namespace vpdr::dataset
