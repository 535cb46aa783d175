#pragma once
// All that vision makes of a frame: motion from every frame, heading relative to the corridor at a
// rate of its own, so that the search for vanishing points does not hold up tracking.
//
//   FrameAnalysis vision(config, camera);
//   vision.add(step);                                         // as pdr sees them
//   const OdometryOutput motion = vision.look_for_motion(image, stamp_ns, attitude);
//   if (vision.heading_is_due(stamp_ns)) vision.look_for_heading(image, stamp_ns, attitude);
//
// Thread safety: add() and look_for_motion() belong to one thread at a time, heading_is_due() and
// look_for_heading() to one at a time; the two pairs share nothing but the vertical that
// look_for_heading() returns. No errors leave it: see the two outcomes.
#include <optional>

#include "vision/core/heading/vanishing_point_heading.hpp"
#include "vision/core/odometry/visual_odometry.hpp"

namespace vpdr::vision {

struct AnalysisConfig {
  VisionConfig heading;
  OdometryConfig odometry;
  double heading_period_s = 0.1;  ///< between frames that are searched for vanishing points
};

class FrameAnalysis {
 public:
  FrameAnalysis(const AnalysisConfig& config, const CameraModel& camera);

  void add(const StepEvent& step) { odometry_.add(step); }
  /// `up_camera`: the vertical where `attitude` does not tell it.
  OdometryOutput look_for_motion(const cv::Mat& image, TimestampNs stamp_ns,
                                 const std::optional<AttitudePrior>& attitude,
                                 const std::optional<Eigen::Vector3d>& up_camera = std::nullopt);
  /// True where the frame is to be searched for vanishing points.
  [[nodiscard]] bool heading_is_due(TimestampNs stamp_ns) const;
  VisionOutput look_for_heading(const cv::Mat& image, TimestampNs stamp_ns,
                                const std::optional<AttitudePrior>& attitude);

  [[nodiscard]] const VanishingPointHeading& heading() const { return heading_; }
  [[nodiscard]] const VisualOdometry& odometry() const { return odometry_; }

 private:
  double heading_period_s_;
  VanishingPointHeading heading_;
  VisualOdometry odometry_;
  std::optional<TimestampNs> last_heading_ns_;
  cv::Mat grey_;
};

}  // namespace vpdr::vision
