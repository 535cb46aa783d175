#include <gtest/gtest.h>

#include "vision/core/odometry/feature_tracks.hpp"

namespace vpdr::vision {
namespace {

TrackedFeature at(FeatureId id, double x, double y) {
  TrackedFeature f;
  f.id = id;
  f.pixel = {x, y};
  return f;
}

TEST(FeatureTracks, FindsPointsByTheirId) {
  FeatureTracks tracks;
  tracks.features = {at(3, 1, 1), at(7, 2, 2), at(20, 3, 3)};
  ASSERT_NE(tracks.find(7), nullptr);
  EXPECT_EQ(tracks.find(7)->pixel.x(), 2.0);
  EXPECT_EQ(tracks.find(8), nullptr);
  EXPECT_EQ(tracks.find(21), nullptr);
}

TEST(FeatureTracks, PairsWhatBothFramesSee) {
  FeatureTracks a, b;
  a.features = {at(1, 0, 0), at(3, 0, 0), at(5, 0, 0), at(9, 0, 0)};
  b.features = {at(2, 0, 0), at(3, 3, 4), at(9, 0, 1), at(12, 0, 0)};
  std::vector<FeatureId> ids;
  for_each_match(a, b, [&](const TrackedFeature& x, const TrackedFeature& y) {
    EXPECT_EQ(x.id, y.id);
    ids.push_back(x.id);
  });
  EXPECT_EQ(ids, (std::vector<FeatureId>{3, 9}));
  std::vector<double> buffer;
  const Displacement moved = displacement_between(a, b, buffer);
  EXPECT_EQ(moved.matches, 2U);
  EXPECT_EQ(moved.median_px, 1.0);  // of 1 and 5 the lower
  EXPECT_EQ(displacement_between(a, {}, buffer).matches, 0U);
}

}  // namespace
}  // namespace vpdr::vision
