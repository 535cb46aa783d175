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
#include "vision/core/frame_check.hpp"
#include "vision/core/heading/building_directions.hpp"
#include "vision/core/heading/corridor_tracker.hpp"
#include "vision/core/heading/heading_angles.hpp"

namespace vpdr::vision {

/// How the angles follow from the vanishing directions.
enum class AngleForm : std::uint8_t {
  kUnitRay,    ///< heading and pitch of the optical axis, and roll: exact
  kAsPrinted,  ///< S1.6: heading and pitch from the main point, for small angles, no roll
  kTriplet     ///< S1.7: roll, pitch and yaw from the three directions
};

struct VisionConfig {
  DirectionsConfig directions;
  TrackerConfig tracker;
  AttitudeTrackConfig attitude;  ///< of the track that gives each frame its attitude
  AngleForm angle_form = AngleForm::kUnitRay;
};

struct VisionOutput {
  FrameOutcome outcome = FrameOutcome::kEmpty;
  CorridorHeading heading;
  std::optional<HeadingRate> rate;
  double roll_rad = 0.0;                ///< positive with the right side down; S1.6 knows none
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
  [[nodiscard]] const CameraModel& camera() const { return directions_.camera(); }
  /// Segments of the last frame, for display.
  [[nodiscard]] const std::vector<LineSegment>& last_segments() const {
    return directions_.segments();
  }

 private:
  FrameOutcome look(const cv::Mat& image, const std::optional<AttitudePrior>& prior,
                    VisionOutput& out);
  [[nodiscard]] std::optional<ViewAngles> angles_of(const ManhattanFrame& frame) const;
  [[nodiscard]] std::optional<VerticalPrior> vertical_of(
      const std::optional<AttitudePrior>& prior) const;

  VisionConfig config_;
  BuildingDirections directions_;
  CorridorTracker tracker_;
  std::optional<TimestampNs> last_stamp_ns_;
  std::optional<std::uint64_t> last_fingerprint_;        ///< of the last frame that was fit
  Eigen::Vector3d last_up_ = -Eigen::Vector3d::UnitY();  ///< camera axes, of the last heading
  std::array<std::uint64_t, kFrameOutcomeCount> counts_{};
};

}  // namespace vpdr::vision
