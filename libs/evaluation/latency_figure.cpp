#include <algorithm>
#include <array>
#include <cmath>

#include "evaluation/figures.hpp"
#include "evaluation/plot.hpp"

namespace vpdr::evaluation {
namespace {

constexpr double kLeft = 64.0;
constexpr double kRight = 1024.0;
constexpr double kTop = 40.0;
constexpr double kHeight = 170.0;

void draw_percentile(Svg& svg, const Scale& x, const char* name, double value_us, double text_y) {
  const double at = x(std::log10(std::max(value_us, 1e-3)));
  svg.line({at, text_y + 4.0}, {at, kTop + kHeight}, "marker");
  const bool right_half = at > (kLeft + kRight) / 2.0;
  svg.text({at + (right_half ? -5.0 : 5.0), text_y + 14.0},
           std::string(name) + " " + duration_label(value_us), "legend",
           right_half ? Anchor::kEnd : Anchor::kStart);
}

/// Counts are drawn on a logarithmic scale, for the tail is what matters; one sample is visible.
double log_count(std::uint64_t count) { return std::log10(static_cast<double>(count)) + 0.3; }

void draw_axes(Svg& svg, const Scale& x, const Scale& y) {
  const double bottom = kTop + kHeight;
  for (std::uint64_t count = 1; log_count(count) < y.domain.max; count *= 10) {
    const double at = y(log_count(count));
    svg.line({kLeft, at}, {kRight, at}, "grid");
    svg.text({kLeft - 8.0, at + 4.0}, std::to_string(count), "tick", Anchor::kEnd);
  }
  for (int decade = static_cast<int>(std::floor(x.domain.min)); decade <= x.domain.max; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double at = decade + std::log10(factor);
      if (at < x.domain.min - 1e-9 || at > x.domain.max + 1e-9) continue;
      svg.line({x(at), bottom}, {x(at), bottom + 4.0}, "bar");
      svg.text({x(at), bottom + 18.0}, duration_label(std::pow(10.0, at)), "tick", Anchor::kMiddle);
    }
  }
  svg.text({16.0, kTop + kHeight / 2.0}, "samples", "axis", Anchor::kMiddle, -90.0);
  svg.rect({kLeft, kTop}, kRight - kLeft, kHeight, "frame");
}

}  // namespace

std::optional<Svg> latency_figure(const LatencyReport& latency) {
  if (latency.histogram.empty()) return std::nullopt;
  Svg svg(kFigureWidth, kTop + kHeight + 30.0, "Histogram of latency: " + latency.name);
  std::uint64_t most = 1;
  for (const LatencyBin& bin : latency.histogram) most = std::max(most, bin.count);
  const Scale x{{std::log10(std::max(latency.histogram.front().lower_us, 1e-3)) - 0.05,
                 std::log10(latency.histogram.back().upper_us) + 0.05},
                kLeft,
                kRight};
  const Scale y{{0.0, 1.35 * log_count(most)}, kTop + kHeight, kTop};
  draw_axes(svg, x, y);
  for (const LatencyBin& bin : latency.histogram) {
    const double left = x(std::log10(bin.lower_us));
    const double right = x(std::log10(bin.upper_us));
    const double top = y(log_count(bin.count));
    svg.rect({left + 1.0, top}, right - left - 2.0, kTop + kHeight - top, "bin",
             duration_label(bin.lower_us) + " to " + duration_label(bin.upper_us) + ": " +
                 std::to_string(bin.count) + " samples");
  }
  draw_percentile(svg, x, "p50", latency.p50_us, kTop);
  draw_percentile(svg, x, "p99", latency.p99_us, kTop + 16.0);
  draw_percentile(svg, x, "p99.9", latency.p999_us, kTop + 32.0);
  return svg;
}

}  // namespace vpdr::evaluation
