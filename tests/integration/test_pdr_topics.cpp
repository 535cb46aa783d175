// pdr on the network, fed by hand.
#include <gtest/gtest.h>

#include <csignal>

#include "calibration/board_calibration.hpp"
#include "core/samples.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::testing_support {
namespace {

const Eigen::Vector3d kEarth(0.0, 20.0, -44.0);
const Eigen::Vector3d kBesideSteel(25.0, 25.0, -20.0);
constexpr int kRateHz = 100;
constexpr int kFieldEvery = 10;

/// The variance of yaw on imu/data after each of two spells of standing still: ten seconds beside
/// steel, ten away from it. The board's calibration says what the earth's field is, or does not.
std::array<double, 2> yaw_variances(std::uint32_t domain_id, bool calibrated) {
  TestDomain domain(domain_id);
  Collector attitudes(domain.participant(), dds::topics::kAttitude);
  Collector steps(domain.participant(), dds::topics::kStep);
  Collector headings(domain.participant(), dds::topics::kHeading);
  Collector odometry(domain.participant(), dds::topics::kPdrOdometry);
  Collector progress(domain.participant(), dds::topics::kProgress);
  dds::Publisher calibrations(domain.participant(), dds::topics::kCalibration);
  dds::Publisher imu(domain.participant(), dds::topics::kImuRaw);
  dds::Publisher mag(domain.participant(), dds::topics::kMag);
  auto pdr = domain.start("pdr", {"--wait-for", "observer"});
  domain.say_running();
  EXPECT_TRUE(domain.wait_diagnostic("pdr", "state", "running"));
  EXPECT_TRUE(calibrations.wait_for_matched(1, kPatience) && imu.wait_for_matched(1, kPatience) &&
              mag.wait_for_matched(1, kPatience));

  calibration::BoardCalibration board;
  if (calibrated) {
    board.magnetometer.field_ut = kEarth.norm();
    board.magnetometer.dip_rad = std::atan2(-kEarth.z(), kEarth.y());
  }
  vpdr_msgs::msg::Calibration calibration;
  dds::to_msg(board, 0, calibration);
  EXPECT_TRUE(calibrations.publish(calibration));
  EXPECT_TRUE(calibrations.wait_for_acknowledgments(kPatience));

  std::array<double, 2> variances{};
  sensor_msgs::msg::Imu imu_message;
  sensor_msgs::msg::MagneticField mag_message;
  TimestampNs stamp_ns = 1'000 * kNsPerSecond;
  std::size_t sent = 0;
  for (std::size_t spell = 0; spell < variances.size(); ++spell) {
    for (int i = 0; i < 10 * kRateHz; ++i, ++sent, stamp_ns += kNsPerSecond / kRateHz) {
      if (i % kFieldEvery == 0) {
        dds::to_msg(MagSample{stamp_ns, spell == 0 ? kBesideSteel : kEarth}, mag_message);
        EXPECT_TRUE(mag.publish(mag_message));
      }
      dds::to_msg(ImuSample{stamp_ns, {0.0, 0.0, kGravityMps2}, Eigen::Vector3d::Zero(), true},
                  imu_message);
      EXPECT_TRUE(imu.publish(imu_message));
      // No more on the way than the topics keep for a slow reader.
      if ((sent + 1) % kRateHz == 0 && !attitudes.wait_count(sent + 1)) {
        ADD_FAILURE() << domain.describe("pdr");
        return {};
      }
    }
    variances[spell] = attitudes.messages().back().orientation_covariance()[8];
  }
  pdr.signal(SIGTERM);
  EXPECT_EQ(pdr.wait(kPatience), 0);
  return variances;
}

TEST(PdrTopics, TheCalibratedFieldTellsThatAWalkBeginsBesideSteel) {
  const auto [known_beside, known_away] = yaw_variances(190, true);
  EXPECT_GT(known_beside, 1.0) << "steel was believed";
  EXPECT_LT(known_away, 0.1) << "the earth's field was not believed";
  EXPECT_LT(yaw_variances(191, false)[0], 0.5);
}

}  // namespace
}  // namespace vpdr::testing_support
