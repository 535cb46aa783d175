#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "dataset/camera_calibration.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kEuroc = R"(sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data: [0.0, 0.0, 1.0, 0.1,
         -1.0, 0.0, 0.0, 0.2,
         0.0, -1.0, 0.0, 0.3,
         0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28, 0.07, 0.0002, 1.8e-05]
)";

class CalibrationFile : public ::testing::Test {
 protected:
  CameraCalibration read(const std::string& text) {
    return read_camera_calibration(folder_.write("c.yaml", text));
  }
  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const FileFault& fault) {
      return fault.what();
    }
    return "no fault";
  }
  testing::TemporaryFolder folder_;
};

TEST_F(CalibrationFile, ReadsEuroc) {
  const CameraCalibration camera = read(kEuroc);
  EXPECT_DOUBLE_EQ(camera.fx, 458.654);
  EXPECT_DOUBLE_EQ(camera.cy, 248.375);
  EXPECT_EQ(camera.distortion, Distortion::kRadialTangential);
  EXPECT_THAT(camera.coefficients, ElementsAre(-0.28, 0.07, 0.0002, 1.8e-05));
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.height, 480);
  EXPECT_DOUBLE_EQ(camera.rate_hz, 20.0);
  // The camera looks along the body's forward axis and sits 0.1 m before its origin.
  const Eigen::Vector4d ahead = camera.body_from_camera * Eigen::Vector4d(0, 0, 1, 1);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector4d(1.1, 0.2, 0.3, 1)));
}

TEST_F(CalibrationFile, ReadsKalibrWhoseExtrinsicsAreTheInverse) {
  const CameraCalibration camera = read(R"(cam0:
  camera_model: pinhole
  intrinsics: [300, 301, 320, 240]
  distortion_model: equidistant
  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]
  resolution: [640, 480]
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.0]
  - [0.0, 0.0, -1.0, 0.0]
  - [1.0, 0.0, 0.0, -0.5]
  - [0.0, 0.0, 0.0, 1.0]
height_m: 1.6
)");
  EXPECT_EQ(camera.distortion, Distortion::kEquidistant);
  // A point half a metre before the IMU is at the camera's centre.
  const Eigen::Vector4d centre = camera.body_from_camera * Eigen::Vector4d(0, 0, 0, 1);
  EXPECT_TRUE(centre.isApprox(Eigen::Vector4d(0.5, 0, 0, 1)));
}

TEST_F(CalibrationFile, ReadsCameraInfo) {
  const CameraCalibration camera = read(R"(image_width: 640
image_height: 480
camera_name: x
camera_matrix: {rows: 3, cols: 3, data: [500, 0, 320, 0, 501, 240, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0.2, 0.3, 0.4, 0.5]}
)");
  EXPECT_DOUBLE_EQ(camera.fy, 501.0);
  EXPECT_DOUBLE_EQ(camera.cx, 320.0);
  EXPECT_EQ(camera.coefficients.size(), 5U);
  EXPECT_FALSE(camera.has_mounting);
  EXPECT_EQ(camera.body_from_camera, forward_looking_body_from_camera());
}

TEST_F(CalibrationFile, WhatIsWrittenIsReadAgain) {
  CameraCalibration camera;
  camera.fx = 458.654;
  camera.fy = 457.296;
  camera.cx = 367.215;
  camera.cy = 248.375;
  camera.width = 752;
  camera.height = 480;
  camera.distortion = Distortion::kEquidistant;
  camera.coefficients = {-0.01, 0.02, -0.003, 1e-5};
  camera.has_mounting = true;
  camera.body_from_camera.topRightCorner<3, 1>() << 0.1, -0.2, 0.3;
  camera.timeshift_s = -0.0123;
  camera.height_m = 1.62;
  camera.pitch_rad = -0.1;
  const auto file = folder_.path() / "written.yaml";
  write_camchain(camera, {"a remark: of two: colons"}, file);
  const CameraCalibration read = read_camera_calibration(file);
  EXPECT_DOUBLE_EQ(read.fx, camera.fx);
  EXPECT_DOUBLE_EQ(read.cy, camera.cy);
  EXPECT_EQ(read.coefficients, camera.coefficients);
  EXPECT_EQ(read.distortion, camera.distortion);
  EXPECT_EQ(read.width, 752);
  EXPECT_TRUE(read.has_mounting);
  EXPECT_TRUE(read.body_from_camera.isApprox(camera.body_from_camera, 1e-9));
  EXPECT_DOUBLE_EQ(read.timeshift_s, camera.timeshift_s);
  EXPECT_EQ(read.height_m, camera.height_m);
  EXPECT_EQ(read.pitch_rad, camera.pitch_rad);
  EXPECT_THROW(write_camchain(camera, {}, folder_.path() / "absent" / "c.yaml"), FileFault);
}

TEST_F(CalibrationFile, NamesWhatIsWrong) {
  const auto with = [](std::string_view from, std::string_view to) {
    std::string text = kEuroc;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(fault("a: 1\n"), HasSubstr("c.yaml:1:1: no camera calibration"));
  EXPECT_THAT(fault(with("pinhole", "omni")), HasSubstr("c.yaml:11:15: camera_model: 'omni'"));
  EXPECT_THAT(fault(with("radial-tangential", "wavy")), HasSubstr("'wavy' is not one of"));
  EXPECT_THAT(fault(with(", 248.375", "")), HasSubstr("must have 4 numbers, has 3"));
  EXPECT_THAT(fault(with("[752, 480]", "[0, 480]")), HasSubstr("must be > 0"));
  EXPECT_THAT(fault(with("-1.0, 0.0, 0.0, 0.2", "-2.0, 0.0, 0.0, 0.2")),
              HasSubstr("are no rotation"));
}

}  // namespace
}  // namespace vpdr::dataset
