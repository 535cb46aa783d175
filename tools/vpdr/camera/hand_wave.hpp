#pragma once
// Camera to inertial sensor from a recording of both being waved by hand.
#include <filesystem>
#include <functional>
#include <string>

#include "dataset/camera_calibration.hpp"
#include "vision/core/calibration/camera_imu.hpp"

namespace vpdr::tool {

/// Reads images and samples of the recording, the samples in the sensor's own axes. Throws
/// FileFault where they do not tell the mounting. `progress` gets the share done.
vision::CameraImuCalibration calibrate_hand_wave(const std::filesystem::path& recording,
                                                 const dataset::CameraCalibration& camera,
                                                 const std::function<void(double)>& progress);

/// Puts rotation and time shift into the calibration; the place of the camera stays.
void set_mounting(const vision::CameraImuCalibration& mounting, dataset::CameraCalibration& camera);

std::string describe(const vision::CameraImuCalibration& mounting);

}  // namespace vpdr::tool
