#pragma once
// How a camera turned between its frames, from whatever it sees: corners followed by optical flow
// (Shi and Tomasi 1994; Lucas and Kanade, Bouguet 2001), the essential matrix by RANSAC (Nister
// 2004), refined on all points that agree. For calibration, where time does not matter. The same
// images give the same turns. Not thread-safe; nothing is thrown, not by OpenCV either.
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "vision/core/calibration/camera_imu.hpp"
#include "vision/core/camera_model.hpp"

namespace vpdr::vision {

struct VisualTurnsConfig {
  int max_corners = 300;
  double min_distance_px = 12.0;  ///< of two corners
  double max_return_px = 0.5;     ///< followed back, a corner must end this near its start
  double inlier_px = 1.0;         ///< from the epipolar line
  std::size_t min_inliers = 25;
  double max_interval_s = 0.2;  ///< no turn between frames further apart
};

class VisualTurns {
 public:
  VisualTurns(const VisualTurnsConfig& config, const CameraModel& camera);

  /// The turn since the frame before; nothing for the first one, after a gap, or where too few
  /// points agree. `grey`: 8 bits, of the camera's size.
  std::optional<VisualTurn> add(const cv::Mat& grey, TimestampNs stamp_ns);

 private:
  std::optional<VisualTurn> turn_to(const cv::Mat& grey, TimestampNs stamp_ns);

  VisualTurnsConfig config_;
  CameraModel camera_;
  cv::Mat last_;
  TimestampNs last_ns_ = 0;
};

}  // namespace vpdr::vision
