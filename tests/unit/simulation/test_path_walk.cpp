#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "simulation/path_walk.hpp"
#include "simulation/recording_writer.hpp"

namespace vpdr::simulation {
namespace {

namespace fs = std::filesystem;

/// A recording without camera: 2 s along a quarter circle, the sensor's forward axis -y.
class PathWalkFiles : public testing::Test {
 protected:
  PathWalkFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              ("vpdr_path_" + std::string(test->name()) + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "source" / "imu0");
    std::ofstream(folder_ / "source" / "about.yaml") << "mount: {forward: \"-y\", up: \"+z\"}\n";
    std::ofstream imu(folder_ / "source" / "imu0" / "data.csv");
    imu << "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
    std::ofstream truth(folder_ / "source" / "groundtruth.csv");
    truth << "#timestamp [ns],p_x,p_y,p_z,q_w,q_x,q_y,q_z\n";
    for (int k = 0; k <= 200; ++k) {
      const double angle = 0.5 * kPi * k / 200.0;
      // The body looks along the circle; the sensor is turned from it by a quarter turn left.
      const Eigen::Quaterniond q = from_euler({0.0, 0.0, angle + kPi});
      imu << stamp(k) << ",0,0,0.785,0.1,0.2,9.8\n";
      truth << stamp(k) << "," << 2.0 * std::cos(angle) << "," << 2.0 * std::sin(angle) << ",1.3,"
            << q.w() << "," << q.x() << "," << q.y() << "," << q.z() << "\n";
    }
  }
  ~PathWalkFiles() override { fs::remove_all(folder_); }

  static TimestampNs stamp(int k) { return 5'000'000'000 + k * 10'000'000LL; }

  PathWalkOptions options() const {
    PathWalkOptions options;
    options.path = folder_ / "source";
    options.camera_rate_hz = 5.0;
    return options;
  }

  fs::path folder_;
};

TEST_F(PathWalkFiles, TheCameraLooksWhereTheBodyGoes) {
  const PathWalk walk = read_path_walk(options());
  EXPECT_EQ(walk.imu.size(), 201u);
  ASSERT_EQ(walk.shot.frames.size(), 11u);
  // Half-way the path runs north-west; the default camera looks 7 degrees down.
  const Eigen::Vector3d look = walk.shot.world_from_camera(stamp(100)).linear().col(2);
  EXPECT_NEAR(std::atan2(look.y(), look.x()), 0.75 * kPi, 1e-4);
  EXPECT_NEAR(look.z(), -std::sin(0.122), 1e-4);
}

TEST_F(PathWalkFiles, SamplesAreKeptAndPicturesAdded) {
  PathWalkOptions from = options();
  Camera camera;
  camera.lens = Lens::kEquidistant;
  camera.width = camera.height = 64;
  camera.fx = camera.fy = 24.0;
  camera.cx = camera.cy = 31.5;
  camera.distortion = {0.0035, 0.0007, -0.0021, 0.0002, 0.0};
  from.camera = camera;
  RecordingOptions write;
  write.depth = true;
  const PathWalk walk = read_path_walk(from);
  write_recording(walk, folder_ / "out", write);

  const dataset::Recording read = dataset::read_recording(folder_ / "out");
  EXPECT_EQ(read.report.refused(), 0u);
  ASSERT_EQ(read.imu.size(), 201u);
  EXPECT_NEAR(read.imu[7].angular_velocity_radps.z(), 0.785, 1e-9);
  ASSERT_EQ(read.truth.poses.size(), 201u);
  EXPECT_TRUE(read.about.mount.isApprox(walk.body_from_sensor, 1e-12));
  ASSERT_EQ(read.images.size(), 11u);
  ASSERT_TRUE(read.camera);
  EXPECT_EQ(read.camera->distortion, dataset::Distortion::kEquidistant);
  const Camera back = camera_of(*read.camera);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(back.distortion[i], camera.distortion[i], 1e-9);
  EXPECT_TRUE(back.body_from_camera.isApprox(camera.body_from_camera, 1e-9));

  const Film film(walk.shot);
  const cv::Mat depth =
      cv::imread(folder_ / "out/depth0/data" / (std::to_string(read.images[4].stamp_ns) + ".png"),
                 cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_NEAR(depth.at<std::uint16_t>(40, 31), 1e3 * film.depth(4).at<float>(40, 31), 0.6);
}

TEST_F(PathWalkFiles, AFileOfPosesWithItsSamplesIsAsGood) {
  PathWalkOptions from = options();
  from.path = folder_ / "source" / "groundtruth.csv";
  from.imu = folder_ / "source" / "imu0" / "data.csv";
  from.body_from_sensor = dataset::mount_from_axes("-y", "+z");
  const PathWalk walk = read_path_walk(from), folder = read_path_walk(options());
  EXPECT_EQ(walk.imu.size(), folder.imu.size());
  EXPECT_TRUE(walk.shot.world_from_camera(stamp(33)).isApprox(
      folder.shot.world_from_camera(stamp(33)), 1e-12));
}

TEST_F(PathWalkFiles, WithoutReferenceThereIsNothingToRenderAlong) {
  fs::remove(folder_ / "source" / "groundtruth.csv");
  EXPECT_THROW(read_path_walk(options()), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::simulation
