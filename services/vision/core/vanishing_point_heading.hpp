#pragma once
// The camera's direction relative to the corridor, from one image: straight line segments, their
// vanishing directions, heading and pitch (S1.6), and the heading rate between frames.
//
//   VanishingPointHeading vision(config, camera);
//   const VisionOutput out = vision.process(image, stamp_ns, attitude_at_stamp);
//   if (out.heading.found) use(out.heading.heading_rad, out.heading.sigma_rad);
//
// Heading: yaw of the camera's optical axis, counter-clockwise, relative to the direction of the
// corridor in which it started, unwrapped through turns. World ENU, body forward-left-up, camera
// x right, y down, z forward. Not thread-safe. The same calls give the same numbers, always: there
// is no random choice in it. Errors: a refused frame is an outcome, counted; nothing is thrown.
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/estimates.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/core/corridor_tracker.hpp"
#include "vision/core/frame_check.hpp"
#include "vision/core/heading_angles.hpp"
#include "vision/core/line_segments.hpp"
#include "vision/core/manhattan_search.hpp"

namespace vpdr::vision {

/// How heading and pitch follow from the vanishing point.
enum class AngleForm : std::uint8_t {
  kUnitRay,   ///< exact, roll included
  kAsPrinted  ///< S1.6: small angles, no roll
};

struct VisionConfig {
  LineConfig lines;
  SearchConfig search;
  TrackerConfig tracker;
  FrameCheckConfig frame_check;
  AttitudeTrackConfig attitude;  ///< of the track that gives each frame its attitude
  AngleForm angle_form = AngleForm::kUnitRay;
  int min_inliers = 6;             ///< segments along the two horizontal directions
  double min_support = 0.35;       ///< their summed length over the image diagonal
  double min_explained = 0.4;      ///< share of the segments' length that the directions explain
  double min_contrast = 1.4;       ///< score of the best yaw over the mean over all yaws
  double max_sigma_rad = 0.05;     ///< a vaguer heading is not given out
  double sigma_factor = 2.0;       ///< a building's edges come in bundles and err together
  double noise_floor_rad = 0.001;  ///< of one frame against the next
  double sigma_floor_rad = 0.008;  ///< calibration, mounting, walls not quite square: constant
};

struct VisionOutput {
  FrameOutcome outcome = FrameOutcome::kEmpty;
  CorridorHeading heading;
  std::optional<HeadingRate> rate;
  std::size_t segments = 0;             ///< line segments looked at
  std::optional<ManhattanFrame> frame;  ///< the building's directions, found or not
};

class VanishingPointHeading {
 public:
  VanishingPointHeading(const VisionConfig& config, const CameraModel& camera);

  /// `image`: 8 bits, grey or BGR(A), lens distortion still in it; `prior`: body attitude at
  /// `stamp_ns`, without which the vertical is searched in the image too. Frames must come in the
  /// order of their stamps.
  VisionOutput process(const cv::Mat& image, TimestampNs stamp_ns,
                       const std::optional<AttitudePrior>& prior);

  /// Frames that ended so.
  [[nodiscard]] std::uint64_t count(FrameOutcome outcome) const {
    return counts_[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  /// Segments of the last frame, for display.
  [[nodiscard]] const std::vector<LineSegment>& last_segments() const { return *segments_; }

 private:
  FrameOutcome look(const cv::Mat& image, const std::optional<AttitudePrior>& prior,
                    VisionOutput& out);
  [[nodiscard]] FrameOutcome judge(const ManhattanFrame& frame, double sigma_rad) const;
  [[nodiscard]] std::optional<ViewAngles> angles_of(const ManhattanFrame& frame) const;
  [[nodiscard]] std::optional<VerticalPrior> vertical_of(
      const std::optional<AttitudePrior>& prior) const;

  VisionConfig config_;
  CameraModel camera_;
  LineDetector detector_;
  ManhattanSearch search_;
  CorridorTracker tracker_;
  cv::Mat grey_;
  std::vector<LineSegment> none_;
  const std::vector<LineSegment>* segments_ = &none_;
  std::vector<SphereSegment> lifted_;
  std::optional<TimestampNs> last_stamp_ns_;
  Eigen::Vector3d last_up_ = -Eigen::Vector3d::UnitY();  ///< camera axes, of the last heading
  std::array<std::uint64_t, kFrameOutcomeCount> counts_{};
};

}  // namespace vpdr::vision
