#pragma once
// Points of the world as the camera sees them in one frame, each under an id that it keeps as long
// as it is followed. This is what the front-end hands to whoever estimates motion or structure:
// visual odometry, a sliding window, loop closure. Camera axes: x right, y down, z forward.
// Plain data; copies share nothing.
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/time.hpp"

namespace vpdr::vision {

using FeatureId = std::uint64_t;

/// A point in one frame.
struct TrackedFeature {
  FeatureId id = 0;       ///< never given to another point
  std::uint32_t age = 1;  ///< frames in which it has been seen, 1 when it is new
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< lens distortion still in it
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();   ///< unit
};

/// All points of one frame.
struct FeatureTracks {
  TimestampNs stamp_ns = 0;
  std::vector<TrackedFeature> features;  ///< ascending ids, that is oldest first

  /// The point of this id, or null.
  [[nodiscard]] const TrackedFeature* find(FeatureId id) const;
};

/// Calls `visit(earlier, later)` for each point that both frames see, in the order of ids.
template <class Visit>
void for_each_match(const FeatureTracks& earlier, const FeatureTracks& later, Visit&& visit) {
  auto a = earlier.features.begin();
  for (const TrackedFeature& b : later.features) {
    while (a != earlier.features.end() && a->id < b.id) ++a;
    if (a == earlier.features.end()) return;
    if (a->id == b.id) visit(*a, b);
  }
}

/// Points seen in both frames, and the median and the 90 % quantile of how far they moved.
struct Displacement {
  std::size_t matches = 0;
  double median_px = 0.0;
  double most_px = 0.0;
};
/// `buffer` is working space.
Displacement displacement_between(const FeatureTracks& earlier, const FeatureTracks& later,
                                  std::vector<double>& buffer);

}  // namespace vpdr::vision
