#include <gtest/gtest.h>

#include <optional>

#include "core/rotation.hpp"
#include "pdr/core/attitude/field_average.hpp"
#include "pdr/core/dead_reckoning/steady_start.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

const Vector3d kEarth(0.0, 20.0, -40.0);
constexpr double kPeriod_s = 0.02;

/// Fields at 50 Hz of a body at rest, `at(i)` the i-th from `first` on; the last full block.
template <class At>
std::optional<MeanField> last_of(FieldAverage& average, int first, int count, At at) {
  std::optional<MeanField> last;
  for (int i = first; i < first + count; ++i) {
    average.add({to_ns(kPeriod_s * i), at(i)});
    average.advance(to_ns(kPeriod_s * (i + 0.5)), Eigen::Quaterniond::Identity(), Vector3d::Zero());
    if (const auto block = average.take()) last = block;
  }
  return last;
}

TEST(FieldAverage, IsTheMeanOfABlock) {
  FieldAverage average(0.25, 0.5);
  const auto mean = last_of(average, 0, 14, [](int i) -> Vector3d {
    return kEarth + Vector3d(i % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0);
  });
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->horizontal_ut.x(), 0.0, 0.1);
  EXPECT_NEAR(mean->horizontal_ut.y(), 20.0, 1e-9);
  EXPECT_NEAR(mean->up_ut, -40.0, 1e-9);
  EXPECT_EQ(average.outliers(), 0U);
}

TEST(FieldAverage, AReadingIsTurnedBackToWhenItWasTaken) {
  // A board that turns at 1 rad/s reads a field 30 ms old: that of where it pointed then.
  FieldAverage average(0.25, 0.5);
  std::optional<MeanField> mean;
  const auto attitude = [](double t) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(t, Vector3d::UnitZ()));
  };
  for (int i = 0; i < 14; ++i) {
    const double t = kPeriod_s * i;
    average.add({to_ns(t), attitude(t - 0.03).conjugate() * kEarth});
    average.advance(to_ns(t + 0.01), attitude(t + 0.01), Vector3d::UnitZ(), 0.03);
    if (const auto block = average.take()) mean = block;
  }
  ASSERT_TRUE(mean);
  EXPECT_NEAR((mean->horizontal_ut - kEarth.head<2>()).norm(), 0.0, 1e-9);
}

TEST(FieldAverage, AnOverflowIsLeftOut) {
  FieldAverage average(0.25, 0.5);
  const auto mean = last_of(average, 0, 14, [](int i) -> Vector3d {
    return i == 5 ? Vector3d::Constant(-409.6) : kEarth;
  });
  ASSERT_TRUE(mean);
  EXPECT_NEAR((mean->horizontal_ut - kEarth.head<2>()).norm(), 0.0, 1e-9);
  EXPECT_EQ(average.outliers(), 1U);
}

TEST(FieldAverage, NoBlockSpansAGap) {
  FieldAverage average(0.25, 0.5);
  EXPECT_FALSE(last_of(average, 0, 10, [](int) { return kEarth; }));
  // Two seconds later the body has turned: what it saw before in the frame of then is void.
  const auto mean = last_of(average, 110, 14, [](int) -> Vector3d { return {20.0, 0.0, -40.0}; });
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->horizontal_ut.x(), 20.0, 1e-9);
  EXPECT_NEAR(mean->horizontal_ut.y(), 0.0, 1e-9);
}

MeanField field(double north_ut) {
  MeanField mean;
  mean.horizontal_ut = {0.0, north_ut};
  return mean;
}

TEST(SteadyStart, WaitsForFourAlike) {
  SteadyStart start;
  EXPECT_FALSE(start.has_settled(field(-40.0)));  // what the registers held
  EXPECT_FALSE(start.has_settled(field(20.0)));
  EXPECT_FALSE(start.has_settled(field(21.0)));
  EXPECT_FALSE(start.has_settled(field(19.0)));
  EXPECT_TRUE(start.has_settled(field(20.0)));
  EXPECT_TRUE(start.has_settled(field(-40.0))) << "once is enough";
}

TEST(SteadyStart, DoesNotWaitForEver) {
  SteadyStart start;
  for (int i = 1; i < 20; ++i) EXPECT_FALSE(start.has_settled(field(i % 2 == 0 ? 40.0 : 10.0)));
  EXPECT_TRUE(start.has_settled(field(40.0)));
}

}  // namespace
}  // namespace vpdr::pdr
