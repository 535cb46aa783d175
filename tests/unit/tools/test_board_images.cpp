// Calibration of real chessboard images. Goals: OpenCV's set at no more than 0.40 px, its
// intrinsics within the uncertainty of the reference that comes with it; the 80 mm set calibrated
// too.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "tests/support/recordings.hpp"
#include "vpdr/camera/board_images.hpp"
#include "vpdr/camera/hand_wave.hpp"
#include "vpdr/camera/image_folder.hpp"
#include "vpdr/camera/live_boards.hpp"

namespace vpdr::tool {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> matching(const fs::path& folder, const std::string& start) {
  std::vector<fs::path> files = images_in(folder);
  std::erase_if(files,
                [&](const fs::path& f) { return !f.filename().string().starts_with(start); });
  return files;
}

vision::IntrinsicsCalibration calibrate(const std::vector<fs::path>& files,
                                        const vision::Chessboard& board) {
  const BoardImages found = find_boards(files, board, [](double) {});
  const auto result = vision::calibrate_intrinsics(found.views, board, found.size, {});
  if (!result) throw FileFault(result.error().message);
  std::printf("%s", describe(result.value()).c_str());
  return result.value();
}

// A board seen straight on, its upper left corner there.
cv::Mat board_at(int x, int y) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 10; ++column) {
      if ((row + column) % 2 == 0) {
        image(cv::Rect(x + 30 * column, y + 30 * row, 30, 30)).setTo(cv::Scalar(20, 20, 20));
      }
    }
  }
  return image;
}

// Shows each image three times; then none.
class ImageShow : public vision::Grabber {
 public:
  explicit ImageShow(std::vector<cv::Mat> images) : images_(std::move(images)) {}
  bool open() override { return !images_.empty(); }
  bool grab(cv::Mat& image) override {
    if (next_ == 3 * images_.size()) return false;
    images_[next_++ / 3].copyTo(image);
    return true;
  }

 private:
  std::vector<cv::Mat> images_;
  std::size_t next_ = 0;
};

TEST(LiveBoards, AViewCountsOnceAndOnlyWithTheBoardInIt) {
  const vision::Chessboard board{9, 6, 0.025};
  const cv::Mat blank(480, 640, CV_8UC3, cv::Scalar(200, 200, 200));
  ImageShow show({board_at(40, 40), blank, board_at(43, 41), board_at(260, 200)});
  int told = 0;
  LiveBoardsOptions options;
  options.views = 2;
  const BoardImages found =
      watch_boards(show, "0", board, options, [&](const std::string&) { ++told; });
  ASSERT_EQ(found.views.size(), 2U);
  EXPECT_EQ(told, 2);
  EXPECT_EQ(found.size, cv::Size(640, 480));
  // Corners lie between pixels: 40 + 30 - 0.5.
  const cv::Point2f first = found.views[0].corners.front();
  const cv::Point2f last = found.views[0].corners.back();
  EXPECT_NEAR(std::min(first.x, last.x), 69.5, 0.1);
  EXPECT_NEAR(std::min(first.y, last.y), 69.5, 0.1);
}

TEST(LiveBoards, ASilentCameraIsAFault) {
  const auto ignore = [](const std::string&) {};
  ImageShow absent(std::vector<cv::Mat>{});
  EXPECT_THROW(watch_boards(absent, "7", {9, 6, 0.025}, {}, ignore), DeviceFault);
  ImageShow silent(std::vector<cv::Mat>{board_at(40, 40)});
  EXPECT_THROW(watch_boards(silent, "7", {9, 6, 0.025}, {}, ignore), DeviceFault);
}

TEST(BoardImages, OpenCvsSet) {
  VPDR_REQUIRE_RECORDINGS(data);
  const fs::path folder = data / "vision/chessboard/opencv";
  if (!fs::exists(folder)) GTEST_SKIP() << "skipped: no data";
  const auto c = calibrate(matching(folder, "left"), {9, 6, 0.025});
  EXPECT_LE(c.rms_px, 0.40);
  // The reference's own corners give 0.393 px, twice ours: one of its views is off by 1.18 px. The
  // bounds are two of its standard deviations at that residual (OpenCV's, its fixed aspect).
  EXPECT_NEAR(0.5 * (c.camera.fx_px + c.camera.fy_px), 535.916, 2.0 * 1.3);
  EXPECT_NEAR(c.camera.cx_px, 342.283, 2.0 * 1.4);
  EXPECT_NEAR(c.camera.cy_px, 235.571, 2.0 * 1.4);
}

TEST(BoardImages, SetOfEightyMillimetres) {
  VPDR_REQUIRE_RECORDINGS(data);
  const fs::path folder = data / "vision/chessboard/vins_fusion_left";
  if (!fs::exists(folder)) GTEST_SKIP() << "skipped: no data";
  const auto c = calibrate(images_in(folder), {12, 8, 0.08});
  EXPECT_LE(c.rms_px, 0.5);
}

// EuRoC's camera against its inertial sensor: T_BS of cam0 and one clock are known.
TEST(HandWave, EurocsMountingComesBack) {
  VPDR_REQUIRE_RECORDINGS(data);
  const fs::path folder = data / "vision/euroc_mh01";
  if (!fs::exists(folder)) GTEST_SKIP() << "skipped: no data";
  const auto known = dataset::read_camera_calibration(folder / "mav0/cam0/sensor.yaml");
  auto camera = known;
  const auto mounting = calibrate_hand_wave(folder, camera, [](double) {});
  std::printf("%s", describe(mounting).c_str());
  const Eigen::Matrix3d truth = known.body_from_camera.topLeftCorner<3, 3>();
  const double off =
      Eigen::AngleAxisd(Eigen::Matrix3d(truth.transpose() * mounting.imu_from_camera)).angle();
  std::printf("off by %.3f deg\n", to_degrees(off));
  EXPECT_LT(to_degrees(off), 0.5);
  EXPECT_NEAR(mounting.timeshift_s, 0.0, 0.003);
  set_mounting(mounting, camera);
  EXPECT_TRUE((camera.body_from_camera.topRightCorner<3, 1>() ==
               known.body_from_camera.topRightCorner<3, 1>()));
}

}  // namespace
}  // namespace vpdr::tool
