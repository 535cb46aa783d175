#pragma once
// Straight line segments of an image, and what they say on the calibrated unit sphere: a segment
// spans a plane through the camera, and the direction of the edge in space lies in that plane.
// Camera axes: x right, y down, z forward. Lengths in pixels of the full image.
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/core/camera_model.hpp"
#include "vision/core/heading/edge_lines.hpp"

namespace vpdr::vision {

struct LineConfig {
  int working_width_px = 640;  ///< wider images are first reduced to this width
  EdgeLineConfig edges;
  double min_length_fraction = 0.03;  ///< shorter segments are left out; of the image diagonal
  int max_segments = 400;             ///< the longest ones are kept
  double endpoint_sigma_px = 0.7;     ///< of an end point across its line, in the full image
};

/// Segments of an image of any size. Not thread-safe: keeps its buffers.
class LineDetector {
 public:
  explicit LineDetector(const LineConfig& config) : config_(config), lines_(config.edges) {}

  /// Segments of a grey 8-bit image, longest first. The reference holds until the next call.
  const std::vector<LineSegment>& detect(const cv::Mat& grey);

 private:
  LineConfig config_;
  EdgeLines lines_;
  cv::Mat reduced_;
  std::vector<LineSegment> segments_;
};

/// A segment on the unit sphere. `normal`, `middle` and `along` are a right-handed orthonormal
/// frame: along = normal x middle.
struct SphereSegment {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< of the plane through camera and segment
  Eigen::Vector3d middle = Eigen::Vector3d::UnitZ();  ///< ray to the segment's middle
  Eigen::Vector3d along = Eigen::Vector3d::UnitY();   ///< direction of the segment at its middle
  double weight = 0.0;                                ///< length over image diagonal
  double tilt_sigma_rad = 0.0;   ///< uncertainty of the normal, turning about `middle`
  double shift_sigma_rad = 0.0;  ///< uncertainty of the normal, turning about `along`
  std::size_t source = 0;        ///< index of the segment in the image
};

/// Undistorts the end points only, which costs far less than to undistort the image.
/// `diagonal_px` scales the weights. Segments too short to span a plane are left out.
void lift_to_sphere(const std::vector<LineSegment>& segments, const CameraModel& camera,
                    double diagonal_px, double endpoint_sigma_px,
                    std::vector<SphereSegment>& lifted);

}  // namespace vpdr::vision
