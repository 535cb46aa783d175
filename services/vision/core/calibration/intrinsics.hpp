#pragma once
// A camera's lens from views of a chessboard: pinhole with radial-tangential distortion (Zhang
// 2000, Brown 1966) or equidistant fisheye (Kannala and Brandt 2006), by bundle adjustment over
// all views. Views that do not fit the rest are dropped; what is left tells the residual, and the
// standard deviation of every parameter. Pixels and radians. Pure functions, thread-safe; bad
// input is an Error with its remedy, nothing is thrown.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "vision/core/calibration/chessboard.hpp"
#include "vision/core/camera_model.hpp"

namespace vpdr::vision {

/// The corners of one image, in the order of Chessboard::points().
struct BoardView {
  std::string name;  ///< for messages
  std::vector<cv::Point2f> corners;
};

struct IntrinsicsConfig {
  Distortion lens = Distortion::kRadialTangential;
  bool third_radial = false;      ///< k3 too; Kalibr's radtan has none
  double outlier_factor = 3.0;    ///< a view this many times worse than the median is dropped
  double outlier_floor_px = 0.3;  ///< unless its residual is below this
  std::size_t min_views = 5;
};

struct ViewResidual {
  std::string name;
  double rms_px = 0.0;
  bool dropped = false;
};

/// Standard deviations, in the units of the parameters.
struct IntrinsicsSigma {
  double fx_px = 0.0, fy_px = 0.0, cx_px = 0.0, cy_px = 0.0;
  std::array<double, 5> coefficients{};
};

/// Share of the image that corners have been in: cells of a grid, row by row, with their counts.
struct Coverage {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;
  std::array<int, std::size_t{kColumns} * kRows> cells{};
  double share = 0.0;  ///< of the cells with at least one corner
};

struct IntrinsicsCalibration {
  CameraParameters camera;
  IntrinsicsSigma sigma;
  double rms_px = 0.0;  ///< distance of corner and model, of the views kept
  std::vector<ViewResidual> views;
  Coverage coverage;  ///< of the views kept
};

Result<IntrinsicsCalibration> calibrate_intrinsics(const std::vector<BoardView>& views,
                                                   const Chessboard& board, cv::Size image,
                                                   const IntrinsicsConfig& config);

Coverage coverage_of(const std::vector<BoardView>& views, cv::Size image);

}  // namespace vpdr::vision
