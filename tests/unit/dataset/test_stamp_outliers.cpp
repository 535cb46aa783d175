#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "dataset/stamp_outliers.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr TimestampNs kFirst = 1'700'000'000 * kNsPerSecond;
constexpr TimestampNs kPeriod = 10'000'000;
constexpr TimestampNs kLatest = std::numeric_limits<TimestampNs>::max();
constexpr TimestampNs kEarliest = std::numeric_limits<TimestampNs>::min();

std::vector<TimestampNs> steady(std::size_t rows, TimestampNs period = kPeriod) {
  std::vector<TimestampNs> stamps;
  for (std::size_t i = 0; i < rows; ++i) {
    stamps.push_back(kFirst + static_cast<TimestampNs>(i) * period);
  }
  return stamps;
}

std::vector<std::size_t> outliers_of(const std::vector<TimestampNs>& stamps,
                                     RowsOf kind = RowsOf::kSamples) {
  const std::vector<bool> marks = stamp_outliers(stamps, kind);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i]) rows.push_back(i);
  }
  return rows;
}

TEST(StampOutliers, OneWrongStampIsFoundWhereverItStands) {
  for (const std::size_t row : {0UL, 1UL, 2UL, 500UL, 998UL, 999UL}) {
    auto stamps = steady(1000);
    stamps[row] = kLatest;
    EXPECT_THAT(outliers_of(stamps), ElementsAre(row));
    stamps[row] = kFirst + 100 * kNsPerSecond;
    EXPECT_THAT(outliers_of(stamps), ElementsAre(row));
  }
  for (const TimestampNs wrong : {TimestampNs{0}, kEarliest}) {
    auto stamps = steady(1000);
    stamps[0] = wrong;
    EXPECT_THAT(outliers_of(stamps), ElementsAre(0U));
  }
}

TEST(StampOutliers, SoAreAFewInARow) {
  auto stamps = steady(1000);
  for (const std::size_t row : {0U, 1U, 2U}) stamps[row] = 0;
  for (const std::size_t row : {500U, 501U, 502U}) stamps[row] = kLatest;
  stamps[700] = kFirst + 500 * kNsPerSecond;
  stamps[701] = kFirst + 400 * kNsPerSecond;
  EXPECT_THAT(outliers_of(stamps), ElementsAre(0U, 1U, 2U, 500U, 501U, 502U, 700U, 701U));
}

TEST(StampOutliers, AGapAfterWhichTheClockGoesOnIsNone) {
  for (const std::size_t row : {2U, 500U, 998U}) {
    auto stamps = steady(1000);
    for (std::size_t i = row; i < stamps.size(); ++i) stamps[i] += 3600 * kNsPerSecond;
    EXPECT_THAT(outliers_of(stamps), IsEmpty()) << row;
  }
}

TEST(StampOutliers, SparseRowsAreNone) {
  EXPECT_THAT(outliers_of(steady(5, 100 * kNsPerSecond)), IsEmpty());
  EXPECT_THAT(outliers_of({0, 200 * kNsPerSecond, 210 * kNsPerSecond, 400 * kNsPerSecond}),
              IsEmpty());
  EXPECT_THAT(outliers_of({}), IsEmpty());
  EXPECT_THAT(outliers_of({kEarliest, kLatest}), IsEmpty());
}

TEST(StampOutliers, ALoneEventAtEitherEndIsNone) {
  auto stamps = steady(1000);
  stamps.front() = 0;
  stamps.back() = kLatest;
  EXPECT_THAT(outliers_of(stamps), ElementsAre(0U, 999U));
  EXPECT_THAT(outliers_of(stamps, RowsOf::kEvents), IsEmpty());
  stamps.front() = stamps[500] = kLatest;
  EXPECT_THAT(outliers_of(stamps, RowsOf::kEvents), ElementsAre(0U, 500U));
}

TEST(StampOutliers, AClockThatGoesBackIsNone) {
  auto stamps = steady(1000);
  for (std::size_t i = 500; i < stamps.size(); ++i) stamps[i] -= 1000 * kNsPerSecond;
  stamps[700] = kEarliest;
  EXPECT_THAT(outliers_of(stamps), IsEmpty());
}

}  // namespace
}  // namespace vpdr::dataset
