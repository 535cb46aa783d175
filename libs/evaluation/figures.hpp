#pragma once
// The figures of the report. Each says whether it has anything to show: nullopt where it has not.
#include <optional>

#include "evaluation/report_scene.hpp"
#include "evaluation/svg.hpp"

namespace vpdr::evaluation {

/// Width of every figure, px.
inline constexpr double kFigureWidth = 1040.0;

/// Truth or waypoints, fused and dead-reckoned track, 95 % ellipses, scale; equal axes.
std::optional<Svg> map_figure(const ReportScene& scene);

/// Yaw of the estimate against the truth's, or against the direction between waypoints; below it,
/// what the camera says of its direction relative to the corridor.
std::optional<Svg> heading_figure(const ReportScene& scene);

/// Cadence and step length over time.
std::optional<Svg> step_figure(const ReportScene& scene);

/// Horizontal distance to the truth over time, with the estimate's own 95 % bound.
std::optional<Svg> error_figure(const ReportScene& scene);

/// Histogram of one latency with its percentiles.
std::optional<Svg> latency_figure(const LatencyReport& latency);

}  // namespace vpdr::evaluation
