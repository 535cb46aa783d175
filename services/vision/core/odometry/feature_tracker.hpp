#pragma once
// The front-end: corners that are followed from frame to frame. Contrast is evened out (CLAHE,
// Zuiderveld 1994), corners (Shi and Tomasi 1994) fill the empty cells of a grid, pyramidal optical
// flow (Lucas and Kanade, Bouguet 2001) follows them, and a point that does not find its way back
// is dropped.
//
//   FeatureTracker tracker(config, camera);
//   const FeatureTracks& tracks = tracker.track(grey, stamp_ns, expected_rays);
//
// The flow begins where the points are expected, on as few levels of the pyramid as these
// expectations have been good for in the frame before; where it loses nearly all, it begins where
// the points were, on all levels.
//
// The same calls give the same tracks. Not thread-safe. Its own buffers are kept from frame to
// frame. Errors: images must be 8-bit grey and of one size; the caller checks (check_frame).
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "core/time.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/core/odometry/feature_tracks.hpp"

namespace vpdr::vision {

struct FeatureTrackerConfig {
  int max_features = 150;
  int cell_px = 40;                ///< grid in which corners are sought: at most one new a cell
  double min_distance_px = 10.0;   ///< of two points, nearer ones become one
  double min_corner_score = 3e-4;  ///< smaller eigenvalue, in OpenCV's units for 8-bit images
  double clahe_clip = 3.0;         ///< contrast limit
  int clahe_tiles = 8;             ///< in each direction
  int flow_window_px = 17;
  int flow_levels = 3;         ///< of the pyramid above the full image
  double max_return_px = 0.7;  ///< forth and back again must end this near the start
};

class FeatureTracker {
 public:
  FeatureTracker(const FeatureTrackerConfig& config, const CameraModel& camera);

  /// Follows all points into the next image and fills up with new ones. `expected`: rays on which
  /// the points of tracks() should be now, in their order; none where nothing is known. The
  /// reference holds until the next call.
  const FeatureTracks& track(const cv::Mat& grey, TimestampNs stamp_ns,
                             std::span<const Eigen::Vector3d> expected);

  /// Forgets all points (their ids are not used again), so that the next image starts anew.
  void reset();

  [[nodiscard]] const FeatureTracks& tracks() const { return tracks_; }

 private:
  void prepare(const cv::Mat& grey);
  void begin_where(std::span<const Eigen::Vector3d> expected);
  void follow(std::span<const Eigen::Vector3d> expected);
  std::size_t seek(const std::vector<cv::Point2f>& starts, int levels);
  void learn_reach();
  void keep_the_good(int width, int height);
  bool claim(const cv::Point2f& pixel);
  void fill_up(const cv::Mat& image);
  void add_best_corner(const cv::Mat& image, const cv::Rect& cell);

  FeatureTrackerConfig config_;
  CameraModel camera_;
  cv::Ptr<cv::CLAHE> clahe_;
  cv::Mat even_;                                 ///< image of even contrast
  std::vector<cv::Mat> pyramid_, last_pyramid_;  ///< images and their derivatives
  FeatureTracks tracks_;
  std::vector<cv::Point2f> from_, expected_, to_, back_;  ///< of each point
  std::vector<std::uint8_t> found_, found_back_;
  int levels_;  ///< of the pyramid, on which the next search begins
  std::vector<double> misses_px_;
  std::vector<std::uint8_t> claimed_;  ///< squares of half the least distance
  int claimed_columns_ = 0;
  std::vector<std::uint8_t> occupied_;  ///< cells of the grid
  cv::Mat score_;
  FeatureId next_id_ = 1;
};

}  // namespace vpdr::vision
