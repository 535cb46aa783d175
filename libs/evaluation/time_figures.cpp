#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rotation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/interpolation.hpp"
#include "evaluation/plot.hpp"

namespace vpdr::evaluation {
namespace {

using Mark = LegendEntry::Mark;

constexpr double kLeft = 64.0;
constexpr double kLegendY = 20.0;
constexpr double kFirstTop = 44.0;
constexpr double kTimeAxisHeight = 48.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Beyond this a walker paused: no line joins the steps on either side.
constexpr double kPauseS = 2.0;
/// More dots than this make a cloud and a large file.
constexpr std::size_t kMostDots = 1500;

Range time_range(const ReportScene& scene) { return {0.0, scene.end_s}; }

/// Angles in degrees against time, with a break where they wrap.
class AngleLine {
 public:
  void add(double time_s, double angle_rad) {
    const double degrees = to_degrees(wrap_pi(angle_rad));
    if (!points_.empty() && std::abs(degrees - points_.back().y) > 180.0) {
      points_.push_back({time_s, kNan});
    }
    points_.push_back({time_s, degrees});
  }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
};

std::vector<Point> yaw_line(const ReportScene& scene, const std::vector<StampedPose>& poses) {
  AngleLine line;
  for (const StampedPose& pose : poses) {
    line.add(scene.seconds(pose.stamp_ns), yaw_of(pose.world_from_body));
  }
  return line.points();
}

std::vector<Point> true_yaw_line(const ReportScene& scene) {
  AngleLine line;
  for (const dataset::TruthPose& pose : scene.truth_attitude) {
    line.add(scene.seconds(pose.stamp_ns), yaw_of(pose.world_from_sensor));
  }
  return line.points();
}

/// Direction from waypoint to waypoint, level between them.
std::vector<Point> waypoint_bearing_line(const ReportScene& scene) {
  std::vector<Point> line;
  for (std::size_t i = 1; i < scene.waypoints.size(); ++i) {
    const Eigen::Vector2d way = scene.waypoints[i].position_m - scene.waypoints[i - 1].position_m;
    const double degrees = to_degrees(std::atan2(way.y(), way.x()));
    line.push_back({scene.seconds(scene.waypoints[i - 1].stamp_ns), degrees});
    line.push_back({scene.seconds(scene.waypoints[i].stamp_ns), degrees});
    line.push_back({scene.seconds(scene.waypoints[i].stamp_ns), kNan});
  }
  return line;
}

void draw_yaw(Svg& svg, const ReportScene& scene, const TimeChart::Place& place, bool time_labels) {
  TimeChart chart(svg, place, time_range(scene), {-192.0, 192.0}, "yaw [deg]", time_labels, 90.0);
  if (!scene.truth_attitude.empty()) {
    chart.line(true_yaw_line(scene), "truth");
  } else {
    chart.line(waypoint_bearing_line(scene), "truth");
  }
  chart.line(yaw_line(scene, scene.pdr.poses), "pdr");
  chart.line(yaw_line(scene, scene.fused.poses), "fused");
}

/// Fused minus true yaw, degrees, where both are known.
std::vector<Point> yaw_error_line(const ReportScene& scene) {
  std::vector<StampedAttitude> estimate;
  for (const StampedPose& pose : scene.fused.poses) {
    estimate.push_back({pose.stamp_ns, pose.world_from_body});
  }
  std::vector<Point> line;
  for (const dataset::TruthPose& pose : scene.truth_attitude) {
    const auto attitude = attitude_at(estimate, pose.stamp_ns);
    if (!attitude) continue;
    const double error_rad = wrap_pi(yaw_of(*attitude) - yaw_of(pose.world_from_sensor));
    line.push_back({scene.seconds(pose.stamp_ns), to_degrees(error_rad)});
  }
  return line;
}

/// The range that holds all but the outermost hundredth: the start-up must not flatten the rest.
Range range_of_most(const std::vector<Point>& line) {
  std::vector<double> values;
  values.reserve(line.size());
  for (const Point& p : line) values.push_back(p.y);
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 100;
  Range range;
  range.include(0.0);
  for (std::size_t i = cut; i + cut < values.size(); ++i) range.include(values[i]);
  return range.padded(0.1, 4.0);
}

void draw_vision_heading(Svg& svg, const ReportScene& scene, const TimeChart::Place& place) {
  const auto& rows = scene.run.vision_heading;
  Range range;
  for (const RunVisionHeading& row : rows) range.include(to_degrees(row.heading_rad));
  TimeChart chart(svg, place, time_range(scene), range.padded(0.1, 10.0), "camera [deg]", true);
  const std::size_t stride = 1 + rows.size() / kMostDots;
  for (std::size_t i = 0; i < rows.size(); i += stride) {
    chart.dot(scene.seconds(rows[i].stamp_ns), to_degrees(rows[i].heading_rad), 1.8, "vision");
  }
}

void draw_heading_legend(Svg& svg, const ReportScene& scene) {
  std::vector<LegendEntry> entries;
  if (!scene.truth_attitude.empty()) {
    entries.push_back({"truth", "truth", Mark::kLine});
  } else if (scene.waypoints.size() > 1) {
    entries.push_back({"direction to the next waypoint", "truth", Mark::kLine});
  }
  if (!scene.fused.poses.empty()) entries.push_back({"fused", "fused", Mark::kLine});
  if (!scene.pdr.poses.empty()) entries.push_back({"dead reckoning only", "pdr", Mark::kLine});
  if (!scene.run.vision_heading.empty()) {
    entries.push_back({"camera, relative to the corridor", "vision", Mark::kDot});
  }
  draw_legend(svg, {kLeft, kLegendY}, entries);
}

struct StepSeries {
  std::vector<Point> cadence;  ///< steps a minute
  std::vector<Point> length_m;
};

template <class Steps>
StepSeries series_of(const ReportScene& scene, const Steps& steps) {
  StepSeries series;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double t = scene.seconds(steps[i].stamp_ns);
    const double interval_s =
        i == 0 ? kPauseS : to_seconds(steps[i].stamp_ns - steps[i - 1].stamp_ns);
    if (interval_s < kPauseS) {
      series.cadence.push_back({t, 60.0 / interval_s});
    } else {
      series.cadence.push_back({t, kNan});
      series.length_m.push_back({t, kNan});
    }
    series.length_m.push_back({t, steps[i].length_m});
  }
  return series;
}

void draw_step_panel(Svg& svg, const ReportScene& scene, const TimeChart::Place& place,
                     const std::vector<Point>& counted, const std::vector<Point>& truth,
                     const char* label, bool time_labels) {
  Range range;
  range.include(0.0);
  for (const auto* series : {&counted, &truth}) {
    for (const Point& p : *series) range.include(p.y);
  }
  range.max = std::max(range.max * 1.08, 0.1);
  TimeChart chart(svg, place, time_range(scene), range, label, time_labels);
  chart.line(truth, "truth thin");
  chart.line(counted, "fused thin");
  const std::size_t stride = 1 + counted.size() / kMostDots;
  for (std::size_t i = 0; i < counted.size(); i += stride) {
    chart.dot(counted[i].x, counted[i].y, 2.0, "fused-dot",
              fixed_number(counted[i].x, 2) + " s: " + fixed_number(counted[i].y, 2));
  }
}

/// Radius of the fused pose's 95 % ellipse along its longer axis, over time.
std::vector<Point> bound_line(const ReportScene& scene) {
  std::vector<Point> line;
  for (const StampedCovariance& row : scene.covariance) {
    const double half_sum = row.position_m2.trace() / 2.0;
    const double half_gap = (row.position_m2(0, 0) - row.position_m2(1, 1)) / 2.0;
    const double largest = half_sum + std::hypot(half_gap, row.position_m2(0, 1));
    line.push_back(
        {scene.seconds(row.stamp_ns), std::sqrt(std::max(0.0, largest) * kChiSquare95TwoDof)});
  }
  return line;
}

void draw_error(TimeChart& chart, const Track& track, const char* line_class,
                const char* dot_class) {
  std::vector<Point> line;
  for (std::size_t i = 0; i < track.error_m.size(); ++i) {
    line.push_back({track.error_time_s[i], track.error_m[i]});
  }
  chart.line(line, line_class);
  constexpr std::size_t kFewEnoughForDots = 120;
  if (line.size() > kFewEnoughForDots) return;
  for (const Point& p : line) {
    chart.dot(p.x, p.y, 3.5, dot_class,
              fixed_number(p.x, 1) + " s: " + fixed_number(p.y, 2) + " m");
  }
}

}  // namespace

std::optional<Svg> heading_figure(const ReportScene& scene) {
  if (scene.fused.poses.empty() && scene.pdr.poses.empty()) return std::nullopt;
  constexpr double kYawHeight = 220.0;
  constexpr double kPanelHeight = 100.0;
  constexpr double kGap = 18.0;
  const std::vector<Point> error = yaw_error_line(scene);
  const bool vision = !scene.run.vision_heading.empty();
  const double panels = (error.empty() ? 0.0 : 1.0) + (vision ? 1.0 : 0.0);
  Svg svg(kFigureWidth, kFirstTop + kYawHeight + panels * (kGap + kPanelHeight) + kTimeAxisHeight,
          "Heading over time");
  draw_heading_legend(svg, scene);
  TimeChart::Place place{.top = kFirstTop, .height = kYawHeight};
  draw_yaw(svg, scene, place, panels == 0.0);
  place.top += kYawHeight + kGap;
  place.height = kPanelHeight;
  if (!error.empty()) {
    TimeChart chart(svg, place, time_range(scene), range_of_most(error), "error [deg]", !vision);
    chart.line(error, "fused thin");
    place.top += kPanelHeight + kGap;
  }
  if (vision) draw_vision_heading(svg, scene, place);
  return svg;
}

std::optional<Svg> step_figure(const ReportScene& scene) {
  if (scene.run.steps.size() < 2) return std::nullopt;
  constexpr double kPanelHeight = 120.0;
  constexpr double kGap = 18.0;
  Svg svg(kFigureWidth, kFirstTop + 2.0 * kPanelHeight + kGap + kTimeAxisHeight, "Steps over time");
  const StepSeries counted = series_of(scene, scene.run.steps);
  StepSeries truth;
  if (scene.recording != nullptr) truth = series_of(scene, scene.recording->truth.steps);
  std::vector<LegendEntry> entries = {{"counted step", "fused-dot", Mark::kDot}};
  if (!truth.cadence.empty()) entries.push_back({"truth", "truth thin", Mark::kLine});
  draw_legend(svg, {kLeft, kLegendY}, entries);
  draw_step_panel(svg, scene, {.top = kFirstTop, .height = kPanelHeight}, counted.cadence,
                  truth.cadence, "cadence [1/min]", false);
  draw_step_panel(svg, scene, {.top = kFirstTop + kPanelHeight + kGap, .height = kPanelHeight},
                  counted.length_m, truth.length_m, "length [m]", true);
  return svg;
}

std::optional<Svg> error_figure(const ReportScene& scene) {
  if (scene.fused.error_m.size() < 2) return std::nullopt;
  constexpr double kHeight = 200.0;
  Svg svg(kFigureWidth, kFirstTop + kHeight + kTimeAxisHeight, "Position error over time");
  Range range;
  range.include(0.0);
  for (const Track* track : {&scene.fused, &scene.pdr}) {
    for (const double error : track->error_m) range.include(error);
  }
  // The bound may be far above the errors; it is shown as far as it helps.
  const double most = std::max(1.15 * range.max, 0.1);
  const std::vector<Point> bound = bound_line(scene);
  for (const Point& p : bound) range.include(std::min(p.y, 2.0 * most));
  range.max = std::max(1.08 * range.max, 0.1);
  std::vector<LegendEntry> entries = {{"fused", "fused", Mark::kLine},
                                      {"dead reckoning only", "pdr", Mark::kLine}};
  if (!bound.empty()) entries.push_back({"95 % bound of the fused pose", "ellipse", Mark::kArea});
  draw_legend(svg, {kLeft, kLegendY}, entries);
  {
    TimeChart chart(svg, {.top = kFirstTop, .height = kHeight}, time_range(scene), range,
                    "distance to truth [m]", true);
    chart.band(bound, "ellipse");
    draw_error(chart, scene.pdr, "pdr", "pdr-dot");
    draw_error(chart, scene.fused, "fused", "fused-dot");
  }
  return svg;
}

}  // namespace vpdr::evaluation
