#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/interpolation.hpp"
#include "evaluation/plot.hpp"

namespace vpdr::evaluation {
namespace {

constexpr double kLeft = 64.0;
constexpr double kRight = 1024.0;
constexpr double kTop = 44.0;
constexpr double kLowest = 300.0;   // of the drawing area
constexpr double kHighest = 640.0;  // of the drawing area
constexpr double kTolerancePx = 0.35;
constexpr int kEllipses = 10;
constexpr int kTimeMarks = 60;

/// East and north to pixels, one scale for both.
struct MapFrame {
  Range east;
  Range north;
  double height_px = 0.0;
  double px_per_m = 1.0;
  [[nodiscard]] Point operator()(const Eigen::Vector2d& place) const {
    return {kLeft + (place.x() - east.min) * px_per_m, kTop + (north.max - place.y()) * px_per_m};
  }
};

template <class Poses>
void include_places(const Poses& poses, Range& east, Range& north) {
  for (const auto& pose : poses) {
    east.include(pose.position_m.x());
    north.include(pose.position_m.y());
  }
}

/// Evenly spaced instants of a track, both ends among them.
std::vector<TimestampNs> instants(const Track& track, int count) {
  std::vector<TimestampNs> stamps;
  if (track.poses.empty()) return stamps;
  const TimestampNs first = track.poses.front().stamp_ns;
  const TimestampNs span = track.poses.back().stamp_ns - first;
  for (int i = 0; i <= count; ++i) {
    stamps.push_back(first + static_cast<TimestampNs>(static_cast<double>(span) * i / count));
  }
  return stamps;
}

/// Semi-axes, largest first, and direction of the largest, of a 95 % ellipse.
struct Ellipse95 {
  Eigen::Vector2d radii_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();
};

Ellipse95 ellipse_of(const Eigen::Matrix2d& covariance_m2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance_m2);
  const Eigen::Vector2d radii_m =
      (solver.eigenvalues().cwiseMax(0.0) * kChiSquare95TwoDof).cwiseSqrt();
  return {radii_m.reverse(), solver.eigenvectors().col(1)};
}

/// Makes room for the ellipses, unless they are so large that the track would shrink.
void include_ellipses(const ReportScene& scene, const std::vector<TimestampNs>& stamps, Range& east,
                      Range& north) {
  if (scene.covariance.empty()) return;
  const double room_m = 0.2 * std::max(east.span(), north.span());
  const Range east_limit{east.min - room_m, east.max + room_m};
  const Range north_limit{north.min - room_m, north.max + room_m};
  for (const TimestampNs stamp : stamps) {
    const Eigen::Vector3d place = position_at(scene.fused.poses, stamp);
    const Eigen::Vector2d reach_m =
        (covariance_at(scene.covariance, stamp).position_m2.diagonal() * kChiSquare95TwoDof)
            .cwiseMax(0.0)
            .cwiseSqrt();
    for (const double sign : {-1.0, 1.0}) {
      const double x = place.x() + sign * reach_m.x();
      const double y = place.y() + sign * reach_m.y();
      east.include(std::clamp(x, east_limit.min, east_limit.max));
      north.include(std::clamp(y, north_limit.min, north_limit.max));
    }
  }
}

Range widened(const Range& range, double span) {
  const double middle = (range.min + range.max) / 2.0;
  return {middle - span / 2.0, middle + span / 2.0};
}

std::optional<MapFrame> frame_of(const ReportScene& scene) {
  MapFrame frame;
  for (const Track* track : {&scene.fused, &scene.pdr}) {
    include_places(track->poses, frame.east, frame.north);
  }
  include_places(scene.truth, frame.east, frame.north);
  include_places(scene.waypoints, frame.east, frame.north);
  if (frame.east.empty()) return std::nullopt;
  include_ellipses(scene, instants(scene.fused, kEllipses), frame.east, frame.north);
  constexpr double kShare = 0.06;
  constexpr double kLeastM = 2.0;
  frame.east = frame.east.padded(kShare, kLeastM);
  frame.north = frame.north.padded(kShare, kLeastM);
  const double width_px = kRight - kLeft;
  frame.px_per_m = std::min(width_px / frame.east.span(), kHighest / frame.north.span());
  frame.height_px = std::max(kLowest, frame.north.span() * frame.px_per_m);
  frame.east = widened(frame.east, width_px / frame.px_per_m);
  frame.north = widened(frame.north, frame.height_px / frame.px_per_m);
  return frame;
}

void draw_grid(Svg& svg, const MapFrame& frame) {
  const double step = tick_step(frame.east.span(), 10);
  const double bottom = kTop + frame.height_px;
  for (const double east : ticks(frame.east, step)) {
    const double x = frame({east, 0.0}).x;
    svg.line({x, kTop}, {x, bottom}, "grid");
    svg.text({x, bottom + 18.0}, tick_label(east, step), "tick", Anchor::kMiddle);
  }
  for (const double north : ticks(frame.north, step)) {
    const double y = frame({0.0, north}).y;
    svg.line({kLeft, y}, {kRight, y}, "grid");
    svg.text({kLeft - 8.0, y + 4.0}, tick_label(north, step), "tick", Anchor::kEnd);
  }
  svg.text({(kLeft + kRight) / 2.0, bottom + 37.0}, "x, east [m]", "axis", Anchor::kMiddle);
  svg.text({16.0, kTop + frame.height_px / 2.0}, "y, north [m]", "axis", Anchor::kMiddle, -90.0);
  svg.rect({kLeft, kTop}, kRight - kLeft, frame.height_px, "frame");
}

void draw_scale_bar(Svg& svg, const MapFrame& frame) {
  const double length_m = tick_step(frame.east.span(), 8);
  const Point end{kRight - 18.0, kTop + frame.height_px - 18.0};
  const Point begin{end.x - length_m * frame.px_per_m, end.y};
  svg.rect({begin.x - 10.0, end.y - 24.0}, end.x - begin.x + 20.0, 34.0, "veil");
  svg.line(begin, end, "bar");
  for (const Point& at : {begin, end}) svg.line({at.x, at.y - 4.0}, {at.x, at.y + 4.0}, "bar");
  svg.text({(begin.x + end.x) / 2.0, end.y - 8.0}, tick_label(length_m, length_m) + " m", "legend",
           Anchor::kMiddle);
}

template <class Poses>
std::vector<Point> drawn_line(const Poses& poses, const MapFrame& frame) {
  std::vector<Point> line;
  for (const auto& pose : poses) {
    const Point p = frame(pose.position_m.template head<2>());
    const bool moved =
        line.empty() || std::hypot(p.x - line.back().x, p.y - line.back().y) > kTolerancePx;
    if (moved) line.push_back(p);
  }
  return simplified(line, kTolerancePx);
}

void draw_ellipse(Svg& svg, const MapFrame& frame, const Eigen::Vector2d& place,
                  const Eigen::Matrix2d& covariance_m2, std::string_view tooltip) {
  const auto [radii_m, axis] = ellipse_of(covariance_m2);
  // The screen's y points down, so an angle from east towards north turns the other way.
  const double angle_deg = -to_degrees(std::atan2(axis.y(), axis.x()));
  svg.ellipse(frame(place), radii_m[0] * frame.px_per_m, radii_m[1] * frame.px_per_m, angle_deg,
              "ellipse", tooltip);
}

void draw_ellipses(Svg& svg, const ReportScene& scene, const MapFrame& frame) {
  if (scene.covariance.empty()) return;
  for (const TimestampNs stamp : instants(scene.fused, kEllipses)) {
    const Eigen::Matrix2d& p = covariance_at(scene.covariance, stamp).position_m2;
    const double sigma_m = std::sqrt(std::max(0.0, p.trace() / 2.0));
    draw_ellipse(svg, frame, position_at(scene.fused.poses, stamp).head<2>(), p,
                 "95 % ellipse at " + fixed_number(scene.seconds(stamp), 1) + " s, mean sigma " +
                     fixed_number(sigma_m, 2) + " m");
  }
}

void draw_waypoints(Svg& svg, const ReportScene& scene, const MapFrame& frame) {
  std::vector<Point> line;
  for (std::size_t i = 0; i < scene.waypoints.size(); ++i) {
    line.push_back(frame(scene.waypoints[i].position_m));
  }
  svg.path(line, "truth thin");
  for (std::size_t i = 0; i < scene.waypoints.size(); ++i) {
    const TimestampNs stamp = scene.waypoints[i].stamp_ns;
    std::string tooltip =
        "waypoint " + std::to_string(i + 1) + " at " + fixed_number(scene.seconds(stamp), 1) + " s";
    if (!scene.fused.poses.empty()) {
      const Eigen::Vector2d estimate = position_at(scene.fused.poses, stamp).head<2>();
      svg.line(line[i], frame(estimate), "whisker");
      tooltip += ", fused " + fixed_number((estimate - scene.waypoints[i].position_m).norm(), 2) +
                 " m away";
    }
    svg.circle(line[i], 5.0, "waypoint", tooltip);
  }
}

/// Invisible until hovered: where the estimate was, when.
void draw_time_marks(Svg& svg, const ReportScene& scene, const MapFrame& frame) {
  for (const TimestampNs stamp : instants(scene.fused, kTimeMarks)) {
    const Eigen::Vector2d place = position_at(scene.fused.poses, stamp).head<2>();
    svg.circle(frame(place), 6.0, "hover",
               fixed_number(scene.seconds(stamp), 1) + " s: x " + fixed_number(place.x(), 2) +
                   " m, y " + fixed_number(place.y(), 2) + " m");
  }
}

void draw_ends(Svg& svg, const ReportScene& scene, const MapFrame& frame) {
  if (scene.fused.poses.empty()) return;
  const Point start = frame(scene.fused.poses.front().position_m.head<2>());
  const Point end = frame(scene.fused.poses.back().position_m.head<2>());
  svg.circle(start, 5.5, "start", "start");
  svg.rect({end.x - 5.0, end.y - 5.0}, 10.0, 10.0, "end", "end of the fused track");
}

void draw_map_legend(Svg& svg, const ReportScene& scene) {
  using Mark = LegendEntry::Mark;
  std::vector<LegendEntry> entries;
  if (!scene.truth.empty()) entries.push_back({"truth", "truth", Mark::kLine});
  if (!scene.waypoints.empty()) entries.push_back({"surveyed waypoint", "waypoint", Mark::kDot});
  if (!scene.fused.poses.empty()) entries.push_back({"fused", "fused", Mark::kLine});
  if (!scene.pdr.poses.empty()) entries.push_back({"dead reckoning only", "pdr", Mark::kLine});
  if (!scene.covariance.empty()) entries.push_back({"95 % ellipse", "ellipse", Mark::kArea});
  entries.push_back({"start", "start", Mark::kDot});
  entries.push_back({"end", "end", Mark::kSquare});
  draw_legend(svg, {kLeft, 20.0}, entries);
}

}  // namespace

std::optional<Svg> map_figure(const ReportScene& scene) {
  const std::optional<MapFrame> frame = frame_of(scene);
  if (!frame) return std::nullopt;
  Svg svg(kFigureWidth, kTop + frame->height_px + 48.0, "Map of the walk seen from above");
  draw_map_legend(svg, scene);
  draw_grid(svg, *frame);
  svg.begin_clip({kLeft, kTop}, kRight - kLeft, frame->height_px);
  svg.path(drawn_line(scene.truth, *frame), "truth", "truth");
  draw_ellipses(svg, scene, *frame);
  svg.path(drawn_line(scene.pdr.poses, *frame), "pdr", "dead reckoning only");
  svg.path(drawn_line(scene.fused.poses, *frame), "fused", "fused");
  draw_waypoints(svg, scene, *frame);
  draw_time_marks(svg, scene, *frame);
  draw_ends(svg, scene, *frame);
  draw_scale_bar(svg, *frame);
  svg.end_clip();
  return svg;
}

}  // namespace vpdr::evaluation
