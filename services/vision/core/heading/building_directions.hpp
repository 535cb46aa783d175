#pragma once
// The three directions of the building in one image: is the image fit, its line segments, the
// Manhattan frame they agree on, and whether that is worth anything. Camera axes: x right, y down,
// z forward; radians. No memory of earlier images; the same image gives the same answer, always.
// Errors: a refused image is an outcome; nothing is thrown, not by OpenCV either.
// Not thread-safe: keeps its buffers.
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "vision/core/camera_model.hpp"
#include "vision/core/frame_check.hpp"
#include "vision/core/heading/line_segments.hpp"
#include "vision/core/heading/manhattan_search.hpp"

namespace vpdr::vision {

struct DirectionsConfig {
  LineConfig lines;
  SearchConfig search;
  FreeConfig free;
  FrameCheckConfig frame_check;
  int min_inliers = 6;             ///< segments along the two horizontal directions
  double min_support = 0.35;       ///< their summed length over the image diagonal
  double min_explained = 0.4;      ///< share of the segments' length that the directions explain
  double min_contrast = 1.4;       ///< score of the best yaw over the mean over all yaws
  double max_sigma_rad = 0.05;     ///< a vaguer heading is not given out
  double sigma_factor = 2.0;       ///< a building's edges come in bundles and err together
  double noise_floor_rad = 0.001;  ///< of one frame against the next
  double sigma_floor_rad = 0.008;  ///< calibration, mounting, walls not quite square: constant
};

/// What one image says. `frame` holds the best directions even where they are refused.
struct DirectionsSeen {
  FrameOutcome outcome = FrameOutcome::kEmpty;  ///< kFound, or why there is nothing
  std::size_t segments = 0;                     ///< line segments looked at
  std::optional<ManhattanFrame> frame;
  double heading_noise_rad = 0.0;  ///< standard deviation of the turn about the vertical: what
                                   ///< differs from frame to frame
  double heading_sigma_rad = 0.0;  ///< the same with what stays
  /// Forward, left and up, each by its own segments: unit vectors, nearly orthogonal.
  std::array<Eigen::Vector3d, 3> directions{};
  std::array<double, 3> sigma_rad{};  ///< angle of each of them, all errors
};

class BuildingDirections {
 public:
  BuildingDirections(const DirectionsConfig& config, const CameraModel& camera);

  /// `image`: 8 bits, grey or BGR(A), lens distortion still in it. `vertical`: where it is known;
  /// without it `usual_up` is tried besides the grid of verticals.
  DirectionsSeen look(const cv::Mat& image, const std::optional<VerticalPrior>& vertical,
                      const Eigen::Vector3d& usual_up = -Eigen::Vector3d::UnitY());

  /// The two parts of look(): is the image fit, and what does a fit one say.
  [[nodiscard]] FrameOutcome check(const cv::Mat& image) const;
  DirectionsSeen find(const cv::Mat& image, const std::optional<VerticalPrior>& vertical,
                      const Eigen::Vector3d& usual_up = -Eigen::Vector3d::UnitY());

  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  /// Segments of the last image that was fit, and the same on the sphere.
  [[nodiscard]] const std::vector<LineSegment>& segments() const { return *segments_; }
  [[nodiscard]] const std::vector<SphereSegment>& lifted() const { return lifted_; }

 private:
  void search(const cv::Mat& image, const std::optional<VerticalPrior>& vertical,
              const Eigen::Vector3d& usual_up, DirectionsSeen& seen);
  void add_uncertainty(DirectionsSeen& seen) const;
  [[nodiscard]] FrameOutcome judge(const ManhattanFrame& frame, double sigma_rad) const;

  DirectionsConfig config_;
  CameraModel camera_;
  LineDetector detector_;
  ManhattanSearch search_;
  cv::Mat grey_;
  std::vector<LineSegment> none_;
  const std::vector<LineSegment>* segments_ = &none_;
  std::vector<SphereSegment> lifted_;
};

}  // namespace vpdr::vision
