#include "imu_gateway/core/lower_envelope.hpp"

#include <algorithm>
#include <limits>

namespace vpdr::imu_gateway {
namespace {

/// More corners than jittering arrivals ever leave; a steadily bending clock could leave thousands.
constexpr std::size_t kMostCorners = 128;

}  // namespace

void LowerEnvelope::Hull::clear() {
  points.clear();
  count = 0;
  sum_from_first = 0.0;
}

void LowerEnvelope::Hull::add(const Point& point) {
  if (count == 0) first_x = point.x;
  ++count;
  last_x = point.x;
  sum_from_first += point.x - first_x;
  const auto lies_on_or_above = [&point](const Point& before, const Point& middle) {
    return (middle.y - before.y) * (point.x - before.x) >=
           (point.y - before.y) * (middle.x - before.x);
  };
  while (points.size() >= 2 && lies_on_or_above(points[points.size() - 2], points.back())) {
    points.pop_back();
  }
  if (!points.empty() && points.back().x == point.x) {
    points.back().y = std::min(points.back().y, point.y);
    return;
  }
  if (points.size() == kMostCorners) {  // every other corner leaves a convex chain too
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); i += 2) points[kept++] = points[i];
    points.resize(kept);
  }
  points.push_back(point);
}

std::optional<double> LowerEnvelope::Hull::slope() const {
  if (points.size() < 2) return std::nullopt;
  const double mean_x = first_x + sum_from_first / static_cast<double>(count);
  std::size_t right = 1;
  while (right + 1 < points.size() && points[right].x < mean_x) ++right;
  const Point& a = points[right - 1];
  const Point& b = points[right];
  return (b.y - a.y) / (b.x - a.x);
}

double LowerEnvelope::Hull::level_under(double slope) const {
  double level = std::numeric_limits<double>::infinity();
  for (const Point& point : points) level = std::min(level, point.y - slope * point.x);
  return level;
}

void LowerEnvelope::restart(std::optional<double> slope) {
  given_slope_ = slope;
  older_.clear();
  younger_.clear();
  line_ = {};
}

void LowerEnvelope::add(double x, double y) {
  older_.add({x, y});
  younger_.add({x, y});
  if (younger_.span() >= options_.window) {
    std::swap(older_, younger_);
    younger_.clear();
  }
  fit();
}

void LowerEnvelope::fit() {
  double slope = given_slope_.value_or(0.0);
  const double needed_span = given_slope_ ? options_.trust_span : options_.first_span;
  if (older_.span() >= needed_span) slope = older_.slope().value_or(slope);
  line_.slope = std::clamp(slope, options_.min_slope, options_.max_slope);
  line_.level = older_.level_under(line_.slope);
}

}  // namespace vpdr::imu_gateway
