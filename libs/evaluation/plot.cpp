#include "evaluation/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vpdr::evaluation {
namespace {

constexpr double kLineTolerancePx = 0.35;
constexpr double kLegendMarkPx = 26.0;
constexpr double kCharacterPx = 6.9;  // of the legend's font, on average

bool finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

double distance_to_chord(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length = std::hypot(dx, dy);
  if (length == 0.0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) / length;
}

/// Marks what Douglas and Peucker keep of line[first..last]; a stack, for lines have no bound.
void mark_kept(const std::vector<Point>& line, std::size_t first, std::size_t last,
               double tolerance_px, std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  kept[first] = kept[last] = true;
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double farthest = tolerance_px;
    std::size_t split = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double distance = distance_to_chord(line[i], line[a], line[b]);
      if (distance > farthest) {
        farthest = distance;
        split = i;
      }
    }
    if (split == a) continue;
    kept[split] = true;
    open.emplace_back(a, split);
    open.emplace_back(split, b);
  }
}

}  // namespace

void Range::include(double value) {
  if (!std::isfinite(value)) return;
  if (empty()) {
    min = max = value;
    return;
  }
  min = std::min(min, value);
  max = std::max(max, value);
}

Range Range::padded(double share, double least) const {
  if (empty()) return {0.0, least > 0.0 ? least : 1.0};
  const double padding = std::max(share * span(), (least - span()) / 2.0);
  return {min - padding, max + padding};
}

double tick_step(double span, int count) {
  if (!(span > 0.0)) return 1.0;
  const double raw = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * 0.999) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> ticks(const Range& range, double step) {
  std::vector<double> values;
  const auto first = static_cast<long>(std::ceil(range.min / step - 1e-9));
  const auto last = static_cast<long>(std::floor(range.max / step + 1e-9));
  for (long i = first; i <= last; ++i) values.push_back(static_cast<double>(i) * step);
  return values;
}

std::string tick_label(double value, double step) {
  const int decimals = static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  std::string label = fixed_number(value, std::clamp(decimals, 0, 6));
  if (label.find_first_not_of("-0.") == std::string::npos) label = "0";
  if (label.front() == '-') label.replace(0, 1, "\u2212");
  return label;
}

std::string duration_label(double us) {
  if (us >= 1e6) return short_number(us / 1e6, 2) + " s";
  if (us >= 1e3) return short_number(us / 1e3, us >= 1e5 ? 0 : 2) + " ms";
  return short_number(us, us >= 100.0 ? 0 : 1) + " \u00b5s";
}

std::vector<Point> simplified(const std::vector<Point>& line, double tolerance_px) {
  std::vector<bool> kept(line.size(), false);
  for (std::size_t first = 0; first < line.size();) {
    if (!finite(line[first])) {
      kept[first++] = true;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < line.size() && finite(line[last + 1])) ++last;
    mark_kept(line, first, last, tolerance_px, kept);
    first = last + 1;
  }
  std::vector<Point> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) result.push_back(line[i]);
  }
  return result;
}

double draw_legend(Svg& svg, Point at, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    const double middle = at.x + kLegendMarkPx / 2.0;
    switch (entry.mark) {
      case LegendEntry::Mark::kLine:
        svg.line({at.x, at.y}, {at.x + kLegendMarkPx, at.y}, entry.css_class);
        break;
      case LegendEntry::Mark::kDot:
        svg.circle({middle, at.y}, 4.0, entry.css_class);
        break;
      case LegendEntry::Mark::kSquare:
        svg.rect({middle - 5.0, at.y - 5.0}, 10.0, 10.0, entry.css_class);
        break;
      case LegendEntry::Mark::kArea:
        svg.rect({at.x, at.y - 5.0}, kLegendMarkPx, 10.0, entry.css_class);
        break;
    }
    svg.text({at.x + kLegendMarkPx + 7.0, at.y + 4.0}, entry.text, "legend");
    at.x += kLegendMarkPx + 7.0 + kCharacterPx * static_cast<double>(entry.text.size()) + 22.0;
  }
  return at.x;
}

TimeChart::TimeChart(Svg& svg, const Place& place, Range time_s, Range value,
                     std::string_view value_label, bool time_labels, std::optional<double> step)
    : svg_(svg),
      x_{time_s, place.left, place.right},
      y_{value, place.top + place.height, place.top} {
  const double bottom = place.top + place.height;
  const double y_step =
      step.value_or(tick_step(value.span(), static_cast<int>(place.height / 28.0)));
  for (const double tick : ticks(value, y_step)) {
    svg.line({place.left, y_(tick)}, {place.right, y_(tick)}, tick == 0.0 ? "zero" : "grid");
    svg.text({place.left - 8.0, y_(tick) + 4.0}, tick_label(tick, y_step), "tick", Anchor::kEnd);
  }
  const double x_step = tick_step(time_s.span(), 12);
  for (const double tick : ticks(time_s, x_step)) {
    svg.line({x_(tick), place.top}, {x_(tick), bottom}, "grid");
    if (!time_labels) continue;
    svg.text({x_(tick), bottom + 18.0}, tick_label(tick, x_step), "tick", Anchor::kMiddle);
  }
  if (time_labels) {
    svg.text({(place.left + place.right) / 2.0, bottom + 37.0}, "time [s]", "axis",
             Anchor::kMiddle);
  }
  svg.text({16.0, place.top + place.height / 2.0}, value_label, "axis", Anchor::kMiddle, -90.0);
  svg.rect({place.left, place.top}, place.right - place.left, place.height, "frame");
  svg.begin_clip({place.left, place.top - 1.0}, place.right - place.left, place.height + 2.0);
}

namespace {

/// At most four points a half pixel of time: the first, the last and both extremes. Noisy lines of
/// hours stay small and look the same.
std::vector<Point> column_extremes(const std::vector<Point>& line) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < line.size();) {
    if (!finite(line[i])) {
      result.push_back(line[i++]);
      continue;
    }
    const double column = std::floor(2.0 * line[i].x);
    std::size_t low = i;
    std::size_t high = i;
    const std::size_t first = i;
    for (; i < line.size() && finite(line[i]) && std::floor(2.0 * line[i].x) == column; ++i) {
      if (line[i].y < line[low].y) low = i;
      if (line[i].y > line[high].y) high = i;
    }
    std::array<std::size_t, 4> kept = {first, std::min(low, high), std::max(low, high), i - 1};
    const auto end = std::unique(kept.begin(), kept.end());
    for (auto k = kept.begin(); k != end; ++k) result.push_back(line[*k]);
  }
  return result;
}

}  // namespace

TimeChart::~TimeChart() { svg_.end_clip(); }

std::vector<Point> TimeChart::to_pixels(const std::vector<Point>& values) const {
  std::vector<Point> pixels;
  pixels.reserve(values.size());
  for (const Point& value : values) pixels.push_back(place(value.x, value.y));
  return simplified(column_extremes(pixels), kLineTolerancePx);
}

void TimeChart::line(const std::vector<Point>& values, std::string_view css_class) {
  svg_.path(to_pixels(values), css_class);
}

void TimeChart::band(const std::vector<Point>& values, std::string_view css_class) {
  std::vector<Point> outline = to_pixels(values);
  std::erase_if(outline, [](const Point& p) { return !finite(p); });
  if (outline.empty()) return;
  const double floor = y_(0.0);
  const Point last{outline.back().x, floor};
  const Point first{outline.front().x, floor};
  outline.push_back(last);
  outline.push_back(first);
  svg_.area(outline, css_class);
}

void TimeChart::dot(double time_s, double value, double radius, std::string_view css_class,
                    std::string_view tooltip) {
  if (std::isfinite(value)) svg_.circle(place(time_s, value), radius, css_class, tooltip);
}

}  // namespace vpdr::evaluation
