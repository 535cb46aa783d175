#pragma once
// A recording's camera calibration as vision's camera model.
#include "dataset/camera_calibration.hpp"
#include "vision/core/camera_model.hpp"

namespace vpdr::vision {

/// Throws FileFault where the model is beyond what CameraModel knows: more than five coefficients
/// that are not zero, or no focal length.
CameraModel make_camera(const dataset::CameraCalibration& calibration);

}  // namespace vpdr::vision
