// vision on the network: what the images of a recording become, and when. The observer stands in
// for pdr.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "core/rotation.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "unit/vision/corridor_image.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/frame_analysis.hpp"
#include "vision/source/image_file.hpp"
#include "vpdr_msgs.h"

namespace vpdr::testing_support {
namespace {

using vision::testing::looking;

constexpr TimestampNs kMs = 1'000'000;
constexpr TimestampNs kStart = 1'000'000'000;
constexpr int kFrames = 12;
constexpr int kTorn = 4;

TimestampNs stamp_of(int frame) { return kStart + frame * 100 * kMs; }
double heading_of(int frame) { return 0.3 - 0.04 * frame; }

std::filesystem::path image_of(const std::filesystem::path& folder, int frame) {
  return folder / "cam0/data" / (std::to_string(stamp_of(frame)) + ".png");
}

/// A recording of a camera that turns to the right in a corridor; one image is torn.
void write_recording(const std::filesystem::path& folder) {
  const vision::CameraModel camera(vision::testing::plain_camera());
  std::filesystem::create_directories(folder / "cam0/data");
  std::ofstream list(folder / "cam0/data.csv");
  list << "#timestamp [ns],filename\n";
  for (int i = 0; i < kFrames; ++i) {
    const auto file = image_of(folder, i);
    cv::imwrite(file.string(),
                vision::testing::draw_corridor(camera, looking(heading_of(i), -0.05, 0.0)));
    if (i == kTorn) std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    list << stamp_of(i) << "," << file.filename().string() << "\n";
  }
  std::ofstream(folder / "cam0/sensor.yaml")
      << "sensor_type: camera\n"
         "T_BS:\n  cols: 4\n  rows: 4\n"
         "  data: [0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1]\n"
         "resolution: [640, 480]\ncamera_model: pinhole\n"
         "intrinsics: [500, 500, 319.5, 239.5]\n"
         "distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
}

/// The attitude of the body that carries that camera, as pdr would know it.
AttitudeEstimate attitude_at(TimestampNs stamp_ns) {
  const double turn_rate = -0.4;
  AttitudeEstimate a;
  a.stamp_ns = stamp_ns;
  const double yaw = 0.3 + turn_rate * to_seconds(stamp_ns - kStart);
  a.world_from_body = from_euler({0.0, 0.05, yaw});
  a.covariance_rad2 = Eigen::Vector3d(1e-4, 1e-4, 1.0).asDiagonal();
  a.angular_velocity_radps = a.world_from_body.conjugate() * Eigen::Vector3d(0, 0, turn_rate);
  return a;
}

/// Publishes attitudes each 10 ms, as pdr does.
class Walker {
 public:
  explicit Walker(TestDomain& domain)
      : attitude_(domain.participant(), dds::topics::kAttitude),
        progress_(domain.participant(), dds::topics::kProgress) {}

  void wait_for_vision() {
    ASSERT_TRUE(attitude_.wait_for_matched(1, kPatience));
    ASSERT_TRUE(progress_.wait_for_matched(1, kPatience));
  }
  /// Up to and including `until_ns`; returns when vision has dealt with all of it.
  void walk(TimestampNs until_ns) {
    sensor_msgs::msg::Imu message;
    for (; next_ns_ <= until_ns; next_ns_ += 10 * kMs) {
      dds::to_msg(attitude_at(next_ns_), message);
      attitude_.publish(message);
    }
    ASSERT_TRUE(attitude_.wait_for_acknowledgments(kPatience));
  }
  void say_done(TimestampNs stamp_ns) {
    vpdr_msgs::msg::Progress message;
    message.service("pdr");
    dds::to_msg(stamp_ns, message.header().stamp());
    progress_.publish(message);
  }

 private:
  dds::Publisher<sensor_msgs::msg::Imu> attitude_;
  dds::Publisher<vpdr_msgs::msg::Progress> progress_;
  TimestampNs next_ns_ = kStart - 5 * kMs;
};

struct Expected {
  vision::VisionOutput heading;
  vision::OdometryOutput motion;
};

/// What the algorithms say of the same frames and attitudes, in this process.
std::vector<Expected> expected(const std::filesystem::path& folder) {
  vision::FrameAnalysis analysis({}, vision::CameraModel(vision::testing::plain_camera()));
  vision::AttitudeTrack track;
  for (TimestampNs t = kStart - 5 * kMs; t <= stamp_of(kFrames); t += 10 * kMs) {
    track.add(attitude_at(t));
  }
  std::vector<Expected> out;
  for (int i = 0; i < kFrames; ++i) {
    const auto image = vision::read_image(image_of(folder, i));
    const cv::Mat pixels = image ? image.value() : cv::Mat();
    const auto attitude = track.at(stamp_of(i));
    const auto motion = analysis.look_for_motion(pixels, stamp_of(i), attitude);
    out.push_back({analysis.look_for_heading(pixels, stamp_of(i), attitude), motion});
  }
  return out;
}

/// The topic has the algorithms' motions, which are the camera's turns; the torn frame is bridged.
template <class Motions>
void expect_motions(const std::vector<Expected>& truth, Motions& motions) {
  std::vector<MotionEstimate> wanted;
  for (const Expected& e : truth) {
    if (e.motion.motion) wanted.push_back(*e.motion.motion);
  }
  ASSERT_EQ(wanted.size(), static_cast<std::size_t>(kFrames - 2));
  ASSERT_TRUE(motions.wait_count(wanted.size()));
  const auto seen = motions.messages();
  bool bridged = false;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    MotionEstimate motion;
    dds::from_msg(seen[i], motion);
    EXPECT_EQ(motion.stamp_ns, wanted[i].stamp_ns);
    EXPECT_EQ(motion.rotation.coeffs(), wanted[i].rotation.coeffs());
    EXPECT_EQ(motion.covariance, wanted[i].covariance);
    const double dt = to_seconds(motion.stamp_ns - motion.interval_start_ns);
    EXPECT_NEAR(yaw_of(motion.rotation), -0.4 * dt, 0.01);
    bridged = bridged || dt > 0.15;
  }
  EXPECT_TRUE(bridged);
}

TEST(VisionTopics, ReleasesFramesBySensorTimeAndGivesTheAlgorithmsNumbers) {
  TestDomain domain(170);
  const auto folder = domain.folder() / "walk";
  write_recording(folder);
  Collector headings(domain.participant(), dds::topics::kCorridorHeading);
  Collector rates(domain.participant(), dds::topics::kHeadingRate);
  Collector motions(domain.participant(), dds::topics::kMotion);
  Collector odometry(domain.participant(), dds::topics::kVisionOdometry);
  Collector progress(domain.participant(), dds::topics::kProgress);
  Walker walker(domain);
  auto process = domain.start("vision", {"--recording", folder, "--wait-for", "observer"});
  walker.wait_for_vision();
  ASSERT_TRUE(domain.wait_diagnostic("vision", "state", "running"));

  // The frame at 200 ms waits for the attitude at 205 ms.
  walker.walk(stamp_of(2) - 5 * kMs);
  ASSERT_TRUE(headings.wait_count(2)) << process.last_lines(5);
  walker.walk(stamp_of(2) + 5 * kMs);
  ASSERT_TRUE(headings.wait_count(3));
  EXPECT_EQ(headings.messages().size(), 3U);
  walker.walk(stamp_of(kFrames));
  ASSERT_TRUE(headings.wait_count(kFrames));

  const auto truth = expected(folder);
  const auto seen = headings.messages();
  std::size_t rate_count = 0;
  for (int i = 0; i < kFrames; ++i) {
    const auto k = static_cast<std::size_t>(i);
    CorridorHeading heading;
    dds::from_msg(seen[k], heading);
    EXPECT_EQ(heading.stamp_ns, stamp_of(i));
    EXPECT_EQ(heading.found, i != kTorn);
    EXPECT_EQ(heading.heading_rad, truth[k].heading.heading.heading_rad) << i;
    EXPECT_EQ(heading.sigma_rad, truth[k].heading.heading.sigma_rad) << i;
    if (heading.found) {
      EXPECT_NEAR(heading.heading_rad, heading_of(i), 0.02);
    }
    rate_count += truth[k].heading.rate.has_value();
  }
  ASSERT_TRUE(rates.wait_count(rate_count));
  EXPECT_EQ(rate_count, static_cast<std::size_t>(kFrames - 2));
  expect_motions(truth, motions);
  EXPECT_TRUE(domain.wait_diagnostic("vision", "motion.unfit", "1"));
  EXPECT_TRUE(domain.wait_diagnostic("vision", "frames.undecodable", "1"));
  EXPECT_TRUE(domain.wait_diagnostic("vision", "frames.found", std::to_string(kFrames - 1)));
  EXPECT_NE(process.last_lines(20).find("image is torn"), std::string::npos);
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 0);
}

TEST(VisionTopics, AWalkWithoutImagesIsNotHeldUp) {
  TestDomain domain(171);
  const auto folder = domain.folder() / "walk";
  std::filesystem::create_directories(folder / "imu0");
  std::ofstream(folder / "imu0/data.csv")
      << "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z "
         "[m/s^2]\n1000000000,0,0,0,0,0,9.8\n";
  Walker walker(domain);
  Collector headings(domain.participant(), dds::topics::kCorridorHeading);
  Collector rates(domain.participant(), dds::topics::kHeadingRate);
  Collector motions(domain.participant(), dds::topics::kMotion);
  Collector odometry(domain.participant(), dds::topics::kVisionOdometry);
  Collector progress(domain.participant(), dds::topics::kProgress);
  auto process = domain.start("vision", {"--recording", folder, "--wait-for", "observer"});
  walker.wait_for_vision();
  ASSERT_TRUE(domain.wait_diagnostic("vision", "state", "running"));
  walker.say_done(kStart + 700 * kMs);
  EXPECT_TRUE(progress.wait([](const auto& messages) {
    return std::any_of(messages.begin(), messages.end(), [](const auto& m) {
      return m.service() == "vision" && dds::from_msg(m.header().stamp()) == kStart + 700 * kMs;
    });
  })) << process.last_lines(5);
  EXPECT_TRUE(domain.wait_diagnostic("vision", "idle", "the recording has no images"));
  EXPECT_EQ(domain.diagnostic_of("vision", "state"), "running");
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 0);
}

TEST(VisionTopics, LooksAtTheImagesOfAnotherProcess) {
  TestDomain domain(173);
  const auto folder = domain.folder() / "walk";
  write_recording(folder);
  Collector headings(domain.participant(), dds::topics::kCorridorHeading);
  dds::Publisher<sensor_msgs::msg::CompressedImage> images(domain.participant(),
                                                           dds::topics::kImage);
  auto process =
      domain.start("vision", {"--from-topic", "--calibration", folder / "cam0/sensor.yaml"});
  ASSERT_TRUE(images.wait_for_matched(1, kPatience)) << process.last_lines(5);
  sensor_msgs::msg::CompressedImage message;
  message.format("png");
  const auto send = [&](int frame, TimestampNs stamp_ns) {
    std::ifstream in(image_of(folder, frame), std::ios::binary);
    message.data().assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    dds::to_msg(stamp_ns, message.header().stamp());
    images.publish(message);
  };
  // Images that come before both topics are matched are lost: one each second until one is seen.
  int sent = 0;
  do {
    ASSERT_LT(sent, 60) << process.last_lines(5);
    send(sent % kTorn, stamp_of(sent));
    ++sent;
  } while (!headings.wait_count(1, std::chrono::seconds(1)));
  CorridorHeading heading;
  dds::from_msg(headings.messages().front(), heading);
  EXPECT_TRUE(heading.found);
  const auto frame = static_cast<int>((heading.stamp_ns - kStart) / (100 * kMs));
  EXPECT_NEAR(heading.heading_rad, heading_of(frame % kTorn), 0.02);
  send(kTorn, stamp_of(sent));
  ASSERT_TRUE(headings.wait([](const auto& messages) { return !messages.back().found(); }));
  EXPECT_TRUE(domain.wait_diagnostic("vision", "frames.undecodable", "1"));
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 0);
}

TEST(VisionTopics, SaysThatItsCameraIsAbsent) {
  TestDomain domain(172);
  const auto folder = domain.folder() / "walk";
  write_recording(folder);
  auto process = domain.start(
      "vision", {"--camera", "/dev/no_such_camera", "--calibration", folder / "cam0/sensor.yaml"});
  EXPECT_TRUE(domain.wait_diagnostic("vision", "state", "degraded"));
  EXPECT_EQ(domain.diagnostic_of("vision", "reason"), "the camera gives no frames");
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(kPatience), 0);
}

}  // namespace
}  // namespace vpdr::testing_support
