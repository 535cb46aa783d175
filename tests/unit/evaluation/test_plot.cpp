#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "evaluation/plot.hpp"
#include "evaluation/svg.hpp"

namespace vpdr::evaluation {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Ticks, AreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(tick_step(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(tick_step(11.0, 5), 5.0);
  EXPECT_DOUBLE_EQ(tick_step(120.0, 12), 10.0);
  EXPECT_NEAR(tick_step(0.7, 7), 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(tick_step(0.0, 5), 1.0);
}

TEST(Ticks, LieInsideTheRange) {
  EXPECT_THAT(ticks({-1.5, 4.0}, 2.0), ElementsAre(0.0, 2.0, 4.0));
  EXPECT_THAT(ticks({0.05, 0.31}, 0.1),
              ElementsAre(DoubleNear(0.1, 1e-12), DoubleNear(0.2, 1e-12), DoubleNear(0.3, 1e-12)));
}

TEST(Ticks, LabelsHaveTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_label(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_label(20.0, 5.0), "20");
  EXPECT_EQ(tick_label(-0.25, 0.05), "\u22120.25");
  EXPECT_EQ(tick_label(-0.0, 0.5), "0");
}

TEST(DurationLabel, ChoosesTheUnit) {
  EXPECT_EQ(duration_label(63.04), "63 \u00b5s");
  EXPECT_EQ(duration_label(1250.0), "1.25 ms");
  EXPECT_EQ(duration_label(2e6), "2 s");
}

TEST(Range, GrowsPadsAndIgnoresNan) {
  Range range;
  EXPECT_TRUE(range.empty());
  for (const double value : {2.0, kNan, -1.0}) range.include(value);
  EXPECT_DOUBLE_EQ(range.span(), 3.0);
  EXPECT_DOUBLE_EQ(range.padded(0.1, 1.0).min, -1.3);
  EXPECT_DOUBLE_EQ(range.padded(0.0, 5.0).max, 3.0);
}

TEST(Simplified, KeepsCornersEndsAndBreaks) {
  const auto line =
      simplified({{0, 0}, {1, 0.1}, {2, 0}, {2, 5}, {kNan, kNan}, {3, 3}, {4, 4}, {5, 5}}, 0.3);
  ASSERT_EQ(line.size(), 6U);
  EXPECT_DOUBLE_EQ(line[1].x, 2.0);
  EXPECT_TRUE(std::isnan(line[3].x));
  EXPECT_DOUBLE_EQ(line[5].y, 5.0);
  EXPECT_TRUE(simplified({}, 0.3).empty());
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  const double along =
      length2 == 0.0
          ? 0.0
          : std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2, 0.0, 1.0);
  return std::hypot(p.x - a.x - along * (b.x - a.x), p.y - a.y - along * (b.y - a.y));
}

TEST(Simplified, StaysWithinTheTolerance) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::vector<Point> line;
  Point p;
  for (int i = 0; i < 3000; ++i) {
    p.x += std::abs(normal(random));  // rising, so that a chord's line and its segment agree
    p.y += normal(random);
    line.push_back(p);
  }
  const auto fewer = simplified(line, 2.0);
  EXPECT_LT(fewer.size(), line.size() / 3);
  for (const Point& original : line) {
    double nearest = 1e9;
    for (std::size_t i = 1; i < fewer.size(); ++i) {
      nearest = std::min(nearest, distance_to_segment(original, fewer[i - 1], fewer[i]));
    }
    EXPECT_LE(nearest, 2.0 + 1e-9);
  }
}

TEST(TimeChart, ThinsNoiseButKeepsItsPeaks) {
  Svg svg(1040.0, 200.0, "noise");
  std::mt19937 random(9);
  std::uniform_real_distribution<double> noise(-0.5, 0.5);
  std::vector<Point> line;
  for (int i = 0; i < 400000; ++i) line.push_back({i * 0.01, noise(random)});
  line[123456].y = 0.9;
  {
    TimeChart chart(svg, {.top = 0.0, .height = 100.0}, {0.0, 4000.0}, {-1.0, 1.0}, "y", true);
    chart.line(line, "fused");
  }
  const std::string text = svg.inline_element();
  EXPECT_LT(text.size(), 150000U);
  // The peak: y = 50 - 0.9 * 50 = 5 px.
  EXPECT_THAT(text, HasSubstr(" 5L"));
}

TEST(Svg, EscapesTextAndWritesShortNumbers) {
  EXPECT_EQ(escaped("<a & 'b' \"c\">"), "&lt;a &amp; &#39;b&#39; &quot;c&quot;&gt;");
  EXPECT_EQ(short_number(1.50, 2), "1.5");
  EXPECT_EQ(short_number(-0.04, 1), "0");
  EXPECT_EQ(short_number(100.0, 0), "100");
  Svg svg(10, 10, "x");
  svg.path({{0, 0}, {1, 1}, {kNan, 0}, {2, 2}, {3, 3.25}}, "fused", "a<b");
  EXPECT_THAT(
      svg.inline_element(),
      HasSubstr("<path d=\"M0 0L1 1M2 2L3 3.2\" class=\"fused\"><title>a&lt;b</title></path>"));
}

}  // namespace
}  // namespace vpdr::evaluation
