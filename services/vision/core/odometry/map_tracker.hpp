#pragma once
// The camera's way through a map that it makes as it goes, in a unit of its own (S1.8): two frames
// far enough apart start the map, each further frame is placed among its points, key frames add to
// it. When too few points are left the map is given up and another one started.
// Map axes: those of the camera that started it. Not thread-safe; allocates nothing once its
// buffers have grown.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/estimates.hpp"
#include "vision/core/odometry/feature_tracks.hpp"
#include "vision/core/odometry/landmark_map.hpp"
#include "vision/core/odometry/relative_motion.hpp"

namespace vpdr::vision {

struct MapTrackerConfig {
  RelativeMotionConfig two_frames;
  LandmarkMapConfig map;
  double start_parallax_rad = 0.02;     ///< between the two frames that start a map
  std::size_t start_points = 25;        ///< that agree on their motion
  double key_parallax_rad = 0.015;      ///< since the last key frame makes another one
  double key_share = 0.7;               ///< of the points that the last key frame has, or fewer
  std::size_t least_points = 10;        ///< that agree on a pose, or it is not believed
  double least_share = 0.3;             ///< of the points looked at
  int lost_frames = 5;                  ///< without a pose that is believed give the map up
  double most_acceleration_mps2 = 8.0;  ///< of the camera: bounds how far it is from where it was
                                        ///< headed
  double turn_sigma_rad = 0.1;          ///< of a turn that no gyroscope saw
};

enum class MapState : std::uint8_t {
  kStarting,  ///< waiting for parallax
  kTracking,
  kBridging,  ///< no pose that is believed and few points: going on as before
};

/// One frame's outcome.
struct MapStep {
  MapState state = MapState::kStarting;
  bool new_map = false;  ///< this frame started it: poses before are of another one
  bool key_frame = false;
  bool held = false;  ///< the camera stands still
  CameraPose start;   ///< with new_map: where the frame that began it was
  TimestampNs start_ns = 0;
  CameraPose previous;  ///< the frame before, same map
  CameraPose pose;
  Matrix6d covariance = Matrix6d::Zero();  ///< position (map), rotation (camera axes)
  std::size_t inliers = 0;
  std::optional<RelativeMotion> two_frames;  ///< while starting: since the frame before
  bool new_reference = false;                ///< while starting: the wait begins anew at this frame
};

class MapTracker {
 public:
  explicit MapTracker(const MapTrackerConfig& config);

  /// Gives the map up.
  void restart();
  /// Rays on which the points of the frame before should be at `stamp_ns`, in their order: by the
  /// way the camera went so far, where the last pose is believed, and by `turn` where there is one;
  /// none where neither is.
  void expect(const FeatureTracks& before, TimestampNs stamp_ns,
              const std::optional<RotationPrior>& turn, std::vector<Eigen::Vector3d>& rays);
  /// The next frame. `turn`: since the frame before; `metres`: of the map's unit, as far as known.
  MapStep process(const FeatureTracks& frame, const std::optional<RotationPrior>& turn,
                  double ray_sigma_rad, std::optional<double> metres);
  /// The next frame, of a camera that stands still.
  MapStep hold(const FeatureTracks& frame);

  [[nodiscard]] MapState state() const { return state_; }
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return map_.landmarks(); }

 private:
  MapStep start(const FeatureTracks& frame, const std::optional<RotationPrior>& turn);
  bool begin_map(const FeatureTracks& frame, const RelativeMotion& motion);
  MapStep track(const FeatureTracks& frame, const std::optional<RotationPrior>& turn);
  void give_up();
  void refer_to(const FeatureTracks& frame, const std::optional<RotationPrior>& turn);
  [[nodiscard]] PosePrior predict(double dt_s, const std::optional<RotationPrior>& turn);
  bool is_key_frame(const FeatureTracks& frame, const CameraPose& pose);
  void pair_up(const FeatureTracks& earlier, const FeatureTracks& later);
  void remember(const FeatureTracks& frame, const CameraPose& pose);

  MapTrackerConfig config_;
  RelativeMotionEstimator two_frames_;
  LandmarkMap map_;
  MapState state_ = MapState::kStarting;
  double ray_sigma_rad_ = 1e-3;
  std::optional<double> metres_;
  FeatureTracks last_, reference_, key_;
  std::optional<RotationPrior> since_reference_;  ///< the gyroscope's turn
  CameraPose pose_, key_pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();   ///< map units a second
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();  ///< camera axes
  int lost_ = 0;
  std::vector<RayPair> pairs_;
  std::vector<FeatureId> pair_ids_;
  std::vector<double> values_;
};

}  // namespace vpdr::vision
