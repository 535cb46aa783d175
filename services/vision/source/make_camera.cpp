#include "vision/source/make_camera.hpp"

#include "core/errors.hpp"

namespace vpdr::vision {
namespace {

Distortion lens_of(dataset::Distortion lens) {
  switch (lens) {
    case dataset::Distortion::kRadialTangential:
      return Distortion::kRadialTangential;
    case dataset::Distortion::kEquidistant:
      return Distortion::kEquidistant;
    case dataset::Distortion::kNone:
      break;
  }
  return Distortion::kNone;
}

}  // namespace

CameraModel make_camera(const dataset::CameraCalibration& c) {
  if (!(c.fx > 0.0) || !(c.fy > 0.0)) {
    throw FileFault("camera calibration: the focal length must be > 0; calibrate the camera again");
  }
  CameraParameters p;
  p.width_px = c.width;
  p.height_px = c.height;
  p.fx_px = c.fx;
  p.fy_px = c.fy;
  p.cx_px = c.cx;
  p.cy_px = c.cy;
  p.distortion = lens_of(c.distortion);
  for (std::size_t i = 0; i < c.coefficients.size(); ++i) {
    if (i < p.coefficients.size()) {
      p.coefficients[i] = c.coefficients[i];
    } else if (c.coefficients[i] != 0.0) {
      throw FileFault("camera calibration: distortion coefficient " + std::to_string(i + 1) +
                      " is not known; calibrate with k1 k2 p1 p2 k3 or with equidistant k1..k4");
    }
  }
  p.body_from_camera = c.body_from_camera.topLeftCorner<3, 3>();
  p.position_m = c.body_from_camera.topRightCorner<3, 1>();
  p.height_m = c.height_m.value_or(0.0);
  return CameraModel(p);
}

}  // namespace vpdr::vision
