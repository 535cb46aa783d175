#pragma once
// Visual odometry with metric scale (S1.8, S1.9): how the body moved between two frames, and where
// that has taken it.
//
//   VisualOdometry odometry(config, camera);
//   const OdometryOutput out = odometry.process({grey, stamp_ns, attitude_at_stamp});
//   if (out.motion && out.motion->metric) use(out.motion->translation_m);
//
// Corners are followed (FeatureTracker), a map of their places is kept (MapTracker), the
// gyroscope's turn helps where there is one (GyroAid), floor and steps give the unit (MetricScale),
// standing still is recognised and holds everything. World ENU, body forward-left-up, camera x
// right, y down, z forward; SI. Not thread-safe. The same calls give the same numbers. Errors: a
// frame that cannot be used is an outcome, counted, and is bridged; nothing is thrown.
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/estimates.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/core/frame_check.hpp"
#include "vision/core/odometry/feature_tracker.hpp"
#include "vision/core/odometry/gyro_aid.hpp"
#include "vision/core/odometry/map_tracker.hpp"
#include "vision/core/odometry/metric_scale.hpp"
#include "vision/core/odometry/odometry_chain.hpp"
#include "vision/core/odometry/stillness_watch.hpp"

namespace vpdr::vision {

/// What became of a frame.
enum class MotionOutcome : std::uint8_t {
  kMoved,        ///< placed in the map
  kStill,        ///< the camera stands still
  kStarting,     ///< no map yet: too little parallax
  kBridged,      ///< too few points agree: going on as before
  kFewPoints,    ///< hardly anything to follow
  kAfterGap,     ///< too long after the frame before: a new start
  kNotLater,     ///< not later than the frame before
  kRepeated,     ///< the very image that was there before
  kUnfit,        ///< dark, torn, wrong size, ...: see FrameOutcome
  kLibraryFault  ///< OpenCV gave up on it
};
inline constexpr std::size_t kMotionOutcomeCount = 10;
/// Name for diagnostics: "moved", "still", ...
const char* name_of(MotionOutcome outcome);

struct OdometryConfig {
  FeatureTrackerConfig tracker;
  MapTrackerConfig map;
  GyroAidConfig gyro;
  MetricScaleConfig scale;
  OdometryChainConfig chain;
  StillnessConfig stillness;
  double pixel_sigma_px = 0.5;      ///< of a followed point, each direction
  double covariance_factor = 2.0;   ///< on standard deviations: points err together
  std::size_t least_features = 12;  ///< fewer are not looked at
  double max_gap_s = 0.5;           ///< frames further apart are not compared
  double coast_sigma_mps = 1.0;     ///< of the speed while nothing is seen
};

/// A frame and what is known of it.
struct OdometryInput {
  cv::Mat grey;  ///< 8 bits, one channel
  TimestampNs stamp_ns = 0;
  std::optional<AttitudePrior> attitude;
  /// Up in camera axes where the attitude does not tell, e.g. from vanishing points.
  std::optional<Eigen::Vector3d> up_camera;
};

struct OdometryOutput {
  MotionOutcome outcome = MotionOutcome::kUnfit;
  FrameOutcome frame = FrameOutcome::kFound;  ///< why a frame is unfit
  std::optional<MotionEstimate> motion;       ///< since the last frame that was fit
  std::optional<PoseEstimate> odometry;       ///< once the scale is known
  bool key_frame = false;
};

class VisualOdometry {
 public:
  VisualOdometry(const OdometryConfig& config, const FrameCheckConfig& check,
                 const CameraModel& camera);

  /// Frames must come in the order of their stamps.
  OdometryOutput process(const OdometryInput& input);
  /// A step of the walker: gives the scale where the floor is not in view.
  void add(const StepEvent& step) { scale_.add(step); }

  [[nodiscard]] std::uint64_t count(MotionOutcome outcome) const {
    return counts_[static_cast<std::size_t>(outcome)];
  }
  /// The points of the last frame, for a sliding window or for display.
  [[nodiscard]] const FeatureTracks& tracks() const { return tracker_.tracks(); }
  [[nodiscard]] const MetricScale& scale() const { return scale_; }
  [[nodiscard]] const Eigen::Vector3d& gyro_bias_radps() const { return gyro_.bias_radps(); }

 private:
  MotionOutcome judge(const OdometryInput& input, OdometryOutput& out);
  MotionOutcome follow(const OdometryInput& input, OdometryOutput& out);
  void begin_anew(const OdometryInput& input);
  [[nodiscard]] std::optional<GyroAid::Turn> turn_since_last(const OdometryInput& input) const;
  [[nodiscard]] std::optional<RotationPrior> camera_turn(
      const std::optional<GyroAid::Turn>& turn) const;
  bool is_repeated(const cv::Mat& image);
  void learn_bias(const std::optional<GyroAid::Turn>& turn, const MapStep& step, double dt_s);
  void see_scale(const OdometryInput& input, const MapStep& step);
  [[nodiscard]] MotionEstimate motion_of(const CameraPose& earlier, const CameraPose& later,
                                         const Matrix6d& covariance, double metres) const;
  std::optional<MotionEstimate> describe(const OdometryInput& input, const MapStep& step) const;
  std::optional<MotionEstimate> describe_start(const OdometryInput& input,
                                               const MapStep& step) const;
  void chain_up(const OdometryInput& input, const MapStep& step, OdometryOutput& out);
  void coast(TimestampNs until_ns, const std::optional<AttitudePrior>& attitude);
  [[nodiscard]] std::optional<std::pair<Eigen::Vector3d, double>> up_camera(
      const OdometryInput& input) const;

  OdometryConfig config_;
  FrameCheckConfig check_;
  CameraModel camera_;
  FeatureTracker tracker_;
  MapTracker map_;
  GyroAid gyro_;
  MetricScale scale_;
  OdometryChain chain_;
  StillnessWatch stillness_;
  std::vector<Eigen::Vector3d> expected_;     ///< rays of the points in the next frame
  std::optional<TimestampNs> last_stamp_ns_;  ///< of any frame
  std::optional<TimestampNs> last_fit_ns_;
  std::optional<AttitudePrior> last_attitude_;  ///< at the last fit frame
  std::optional<CameraPose> chain_pose_;        ///< in the map, where the chain's end is
  bool scale_known_once_ = false;
  std::optional<AttitudePrior> chain_attitude_;
  std::optional<std::uint64_t> last_fingerprint_;
  std::array<std::uint64_t, kMotionOutcomeCount> counts_{};
};

}  // namespace vpdr::vision
