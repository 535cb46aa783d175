#include "vision/core/odometry/feature_tracks.hpp"

#include <algorithm>

namespace vpdr::vision {

const TrackedFeature* FeatureTracks::find(FeatureId id) const {
  const auto at =
      std::lower_bound(features.begin(), features.end(), id,
                       [](const TrackedFeature& f, FeatureId wanted) { return f.id < wanted; });
  return at != features.end() && at->id == id ? &*at : nullptr;
}

Displacement displacement_between(const FeatureTracks& earlier, const FeatureTracks& later,
                                  std::vector<double>& buffer) {
  buffer.clear();
  for_each_match(earlier, later, [&](const TrackedFeature& a, const TrackedFeature& b) {
    buffer.push_back((a.pixel - b.pixel).norm());
  });
  if (buffer.empty()) return {};
  const auto quantile = [&](double share) {
    const auto at = buffer.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(buffer.size() - 1));
    std::nth_element(buffer.begin(), at, buffer.end());
    return *at;
  };
  return {buffer.size(), quantile(0.5), quantile(0.9)};
}

}  // namespace vpdr::vision
