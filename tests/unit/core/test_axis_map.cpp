#include <gtest/gtest.h>

#include "core/axis_map.hpp"

namespace vpdr {
namespace {

TEST(AxisMap, OfThreeNames) {
  const auto map = parse_axis_map("+y,-x,+z", false);
  ASSERT_TRUE(map);
  EXPECT_TRUE((map.value() * Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector3d(2, -1, 3)));
}

TEST(AxisMap, ANameIsWhatIsParsed) {
  for (const char* name : {"+x,+y,+z", "+y,-x,+z", "-x,-y,-z", "-z,+x,-y"}) {
    EXPECT_EQ(axis_map_name(parse_axis_map(name, true).value()), name);
  }
}

TEST(AxisMap, TheNearestOfAMatrix) {
  Eigen::Matrix3d matrix;
  matrix << 0.1, 0.9, 0.2, -1.1, 0.2, 0.1, 0.0, -0.2, -0.8;
  EXPECT_EQ(axis_map_name(nearest_axis_map(matrix)), "+y,-x,-z");
}

}  // namespace
}  // namespace vpdr
