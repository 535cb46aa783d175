#pragma once
// Where the tracked points are: each lies on the ray on which a key frame first saw it, at an
// inverse distance that later key frames narrow down (Civera, Davison and Montiel 2008; one filter
// a point). Lengths are in the map's own unit, axes are the map's. A point so far away that nothing
// is known of its distance is a direction, and serves as one. Not thread-safe; allocates nothing
// once it has grown.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "vision/core/odometry/feature_tracks.hpp"

namespace vpdr::vision {

/// Position and attitude of a camera in the map.
struct CameraPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond map_from_camera = Eigen::Quaterniond::Identity();
};

struct Landmark {
  FeatureId id = 0;
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();    ///< where the camera was
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, map axes
  double inverse_distance = 0.0;
  double variance = 0.0;  ///< of the inverse distance
  int misses = 0;         ///< key frames in a row that contradict it

  [[nodiscard]] Eigen::Vector3d position() const { return anchor + bearing / inverse_distance; }
  /// Uncertainty of the distance as a share of it.
  [[nodiscard]] double relative_sigma() const;
};

/// A landmark in a frame: the measured ray, and how what is expected depends on things.
struct Sighting {
  Eigen::Vector2d error = Eigen::Vector2d::Zero();  ///< expected minus measured, across the ray
  Eigen::Matrix<double, 2, 6> by_pose;              ///< position (map), rotation (camera axes)
  Eigen::Vector2d by_inverse_distance = Eigen::Vector2d::Zero();
  bool ahead = false;
};
Sighting sight(const Landmark& landmark, const Eigen::Vector3d& ray, const CameraPose& pose);

struct LandmarkMapConfig {
  double gate = 3.5;  ///< sigmas beyond which a sighting is contradicted
  int max_misses = 2;
  double drift_share = 0.005;  ///< by which a distance may be off again after a key frame
  double unknown_share = 0.6;  ///< sigma of a new point's inverse distance, of the map's typical
};

class LandmarkMap {
 public:
  explicit LandmarkMap(const LandmarkMapConfig& config = {}) : config_(config) {}

  void clear() { landmarks_.clear(); }
  /// Adds or replaces nothing that is there: `id` must be above all in the map.
  void add(const Landmark& landmark) { landmarks_.push_back(landmark); }
  /// A key frame: narrows the distances, drops points that are gone or keep contradicting, and
  /// anchors the frame's new points here. `ray_sigma_rad` across each of two directions;
  /// `position_sigma`: of the camera relative to the map.
  void update(const FeatureTracks& frame, const CameraPose& pose, double ray_sigma_rad,
              double position_sigma);

  /// Ascending ids.
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return landmarks_; }
  /// Median inverse distance of the points that are known; 0 for none.
  [[nodiscard]] double typical_inverse_distance();

 private:
  void narrow(Landmark& landmark, const TrackedFeature& feature, const CameraPose& pose,
              double ray_sigma_rad, double position_sigma) const;

  LandmarkMapConfig config_;
  std::vector<Landmark> landmarks_, next_;
  std::vector<double> values_;
};

/// Calls `visit(feature, landmark)` for each point of the frame, in the order of ids; the landmark
/// is null for a point that the map does not have.
template <class Visit>
void for_each_sighted(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                      Visit&& visit) {
  auto known = landmarks.begin();
  for (const TrackedFeature& f : frame.features) {
    while (known != landmarks.end() && known->id < f.id) ++known;
    visit(f, known != landmarks.end() && known->id == f.id ? &*known : nullptr);
  }
}

/// The camera's pose from the landmarks it sees.
struct PoseFix {
  CameraPose pose;
  Eigen::Matrix<double, 6, 6> covariance;  ///< position (map), rotation (camera axes)
  std::size_t inliers = 0;
  std::size_t seen = 0;  ///< those that key frames contradict included
};

/// What is expected of the pose before the landmarks are looked at.
struct PosePrior {
  CameraPose pose;
  double rotation_sigma_rad = 0.05;
  double position_sigma = 0.1;
};

/// Gauss-Newton on all sightings at once, weighted by what is known of each landmark and by
/// Cauchy's function; starts at the prior, which counts as a measurement.
PoseFix fix_pose(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                 const PosePrior& prior, double ray_sigma_rad);

}  // namespace vpdr::vision
