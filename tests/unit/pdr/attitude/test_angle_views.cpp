#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "pdr/core/attitude/angle_views.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Half-angle values of 60 deg by hand: cos 30 = 0.8660254, sin 30 = 0.5.
const Quaterniond kAboutX(0.8660254037844387, 0.5, 0.0, 0.0);
const Quaterniond kAboutY(0.8660254037844387, 0.0, 0.5, 0.0);
const Quaterniond kAboutZ(0.8660254037844387, 0.0, 0.0, 0.5);

TEST(PaperAngles, PrintedHeadingIsTheTurnAboutX) {
  // 2 (0 + 0.8660254 * 0.5) / (0.75 - 0.25) = 1.7320508.
  EXPECT_NEAR(to_degrees(paper_heading(kAboutX)), 60.0, 1e-9);
  EXPECT_NEAR(paper_heading(kAboutZ), 0.0, 1e-12);
  EXPECT_NEAR(paper_heading(kAboutX), to_euler(kAboutX).roll_rad, 1e-12);
}

TEST(PaperAngles, PrintedRollIsTheTurnAboutZWithTheOtherSign) {
  EXPECT_NEAR(to_degrees(paper_roll(kAboutZ)), -60.0, 1e-9);
  EXPECT_NEAR(paper_roll(kAboutX), 0.0, 1e-12);
  EXPECT_NEAR(paper_roll(kAboutZ), -to_euler(kAboutZ).yaw_rad, 1e-12);
}

TEST(PaperAngles, PrintedPitchIsTheTurnAboutXNotY) {
  // -2 (0 - 0.8660254 * 0.5) = 0.8660254: asin gives 60 deg.
  EXPECT_NEAR(to_degrees(paper_pitch(kAboutX)), 60.0, 1e-6);
  EXPECT_NEAR(paper_pitch(kAboutY), 0.0, 1e-12);
}

TEST(PaperAngles, HeadingIsTheRollOfTheUsualOrderForEveryAttitude) {
  for (double yaw = -3.0; yaw < 3.0; yaw += 0.7) {
    for (double pitch = -1.4; pitch < 1.5; pitch += 0.4) {
      for (double roll = -3.0; roll < 3.0; roll += 0.6) {
        const Quaterniond q = from_euler({roll, pitch, yaw});
        EXPECT_NEAR(wrap_pi(paper_heading(q) - roll), 0.0, 1e-9);
      }
    }
  }
}

TEST(PaperAngles, PitchBelongsToTheOrderYXZ) {
  // (4) is the middle angle of Ry Rx Rz, another order than (3)'s z-y-x.
  const double b = -0.3;
  const Quaterniond q = AngleAxisd(0.4, Vector3d::UnitY()) * AngleAxisd(b, Vector3d::UnitX()) *
                        AngleAxisd(1.1, Vector3d::UnitZ());
  EXPECT_NEAR(paper_pitch(q), b, 1e-9);
  EXPECT_GT(std::abs(paper_heading(q) - b), 0.1);
}

TEST(PaperAngles, PitchIsHeldAtTheEndsOfTheArcsine) {
  const Quaterniond quarter(AngleAxisd(0.5 * kPi, Vector3d::UnitX()));
  EXPECT_NEAR(paper_pitch(quarter), 0.5 * kPi, 1e-6);
}

}  // namespace
}  // namespace vpdr::pdr
