#pragma once
// Axes, ticks and lines of the report's charts.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/svg.hpp"

namespace vpdr::evaluation {

/// A closed range of values; starts empty and grows with include().
struct Range {
  double min = 1.0;
  double max = -1.0;
  [[nodiscard]] bool empty() const { return min > max; }
  [[nodiscard]] double span() const { return empty() ? 0.0 : max - min; }
  void include(double value);  ///< not-finite values are passed over
  /// The range with `share` of its span added on either side, at least `least` wide in all.
  [[nodiscard]] Range padded(double share, double least) const;
};

/// A step of 1, 2 or 5 times a power of ten with about `count` steps in `span`.
double tick_step(double span, int count);

/// Multiples of `step` inside the range.
std::vector<double> ticks(const Range& range, double step);

/// A tick's label with no more decimals than its step needs.
std::string tick_label(double value, double step);

/// Microseconds in the unit that suits: "63 µs", "1.25 ms", "2 s".
std::string duration_label(double us);

/// Fewer points for the same line: Douglas and Peucker, keeping within `tolerance_px`; breaks (not
/// finite points) are kept.
std::vector<Point> simplified(const std::vector<Point>& line, double tolerance_px);

/// Maps values to pixels.
struct Scale {
  Range domain;
  double from_px = 0.0;
  double to_px = 1.0;
  [[nodiscard]] double operator()(double value) const {
    return from_px + (value - domain.min) / domain.span() * (to_px - from_px);
  }
};

/// What a legend says of one series.
struct LegendEntry {
  enum class Mark { kLine, kDot, kSquare, kArea };
  std::string text;
  std::string css_class;
  Mark mark = Mark::kLine;
};

/// Entries in a row from `at` to the right; returns where the next would start.
double draw_legend(Svg& svg, Point at, const std::vector<LegendEntry>& entries);

/// One chart over time in its place of a figure: frame, grid, labelled axes, clipped contents. The
/// clip ends with the object, so it must go before the figure is returned.
class TimeChart {
 public:
  struct Place {
    double top = 0.0;
    double height = 160.0;
    double left = 64.0;
    double right = 1024.0;
  };
  /// Draws the frame. `step` fixes the y ticks (90 degrees); without it they are chosen. The time
  /// axis has its labels only where `time_labels`.
  TimeChart(Svg& svg, const Place& place, Range time_s, Range value, std::string_view value_label,
            bool time_labels, std::optional<double> step = std::nullopt);
  ~TimeChart();
  TimeChart(const TimeChart&) = delete;
  TimeChart& operator=(const TimeChart&) = delete;

  [[nodiscard]] Point place(double time_s, double value) const { return {x_(time_s), y_(value)}; }
  /// Line through (time, value) points, thinned.
  void line(const std::vector<Point>& values, std::string_view css_class);
  /// Area between 0 and the values.
  void band(const std::vector<Point>& values, std::string_view css_class);
  /// A dot for each, with its tooltip.
  void dot(double time_s, double value, double radius, std::string_view css_class,
           std::string_view tooltip = {});

 private:
  [[nodiscard]] std::vector<Point> to_pixels(const std::vector<Point>& values) const;
  Svg& svg_;
  Scale x_;
  Scale y_;
};

}  // namespace vpdr::evaluation
