#include "bench/pdr_figures.hpp"

#include <cmath>

#include "bench/waypoint_fit.hpp"
#include "core/rotation.hpp"
#include "evaluation/attitude_errors.hpp"
#include "evaluation/step_errors.hpp"
#include "evaluation/trajectory_errors.hpp"
#include "evaluation/waypoint_errors.hpp"

namespace vpdr::bench {
namespace {

const double kNone = std::nan("");

/// Length of the walking bouts' steps over their true length, in percent more: all steps but a
/// bout's first, which leads into it; unknown ones as long as the mean.
double distance_error_percent(const Result& result) {
  const auto& truth = result.recording.truth;
  if (!truth.walking_bouts) return kNone;
  double true_m = 0.0;
  double counted_m = 0.0;
  for (const dataset::Interval& bout : *truth.walking_bouts) {
    double known_m = 0.0;
    double known = 0.0;
    double steps = 0.0;
    for (const dataset::TrueStep& step : truth.steps) {
      if (step.stamp_ns <= bout.begin_ns || step.stamp_ns > bout.end_ns) continue;
      steps += 1.0;
      if (!std::isfinite(step.length_m)) continue;
      known_m += step.length_m;
      known += 1.0;
    }
    if (known == 0.0) continue;
    true_m += known_m / known * steps;
    for (const evaluation::RunStep& step : result.run.steps) {
      const bool within = step.stamp_ns > bout.begin_ns + evaluation::kStepMatchNs &&
                          step.stamp_ns <= bout.end_ns + evaluation::kStepMatchNs;
      if (within) counted_m += step.length_m;
    }
  }
  return true_m > 0.0 ? 100.0 * (counted_m / true_m - 1.0) : kNone;
}

/// Length of the steps between the first and the last waypoint over the straight lines between
/// all of them, in percent more.
double scale_percent(const Result& result) {
  const auto& waypoints = result.recording.truth.waypoints;
  double straight_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    straight_m += (waypoints[i].position_m - waypoints[i - 1].position_m).norm();
  }
  double walked_m = 0.0;
  for (const evaluation::RunStep& step : result.run.steps) {
    const bool between =
        step.stamp_ns > waypoints.front().stamp_ns && step.stamp_ns <= waypoints.back().stamp_ns;
    if (between) walked_m += step.length_m;
  }
  return 100.0 * (walked_m / straight_m - 1.0);
}

}  // namespace

Row waypoint_figures(const Result& result) {
  const auto errors =
      evaluation::waypoint_errors(result.run.fused, result.recording.truth.waypoints);
  if (!errors) return Row(11, kNone);
  const Honesty honesty = honesty_of(result.run, result.recording.truth.waypoints);
  const Fitted fitted = fitted_to_waypoints(result.run, result.recording.truth.waypoints);
  return {errors->mean_m,
          errors->final_m,
          errors->final_percent,
          errors->max_m,
          fitted.turned_m,
          fitted.scaled_m,
          fitted.turn_deg,
          honesty.nees,
          honesty.inside_percent,
          scale_percent(result),
          result.duration_s / result.taken_s};
}

Row there_and_back_figures(const Result& result) {
  const Eigen::Vector2d end = result.run.fused.back().position_m.head<2>();
  double path_m = 0.0;
  for (const auto& step : result.run.steps) path_m += step.length_m;
  return {static_cast<double>(result.run.steps.size()), path_m, end.norm(),
          to_degrees(std::atan2(end.y(), end.x()))};
}

Row step_figures(const Result& result) {
  const auto errors = evaluation::step_errors(result.run, result.recording);
  if (!errors) return {kNone, kNone, kNone};
  return {static_cast<double>(errors->truth), static_cast<double>(errors->counted),
          errors->error_percent};
}

Row timing_figures(const Result& result) {
  Row row = step_figures(result);
  row.insert(row.end(), {result.highest_m, result.floor_changes});
  const auto errors = evaluation::step_errors(result.run, result.recording);
  if (!errors || !errors->timing) {
    row.insert(row.end(), {kNone, kNone, kNone, kNone, kNone});
    return row;
  }
  const auto& timing = *errors->timing;
  row.insert(row.end(),
             {timing.recall_percent, timing.precision_percent, timing.mean_offset_s,
              timing.length_bias_percent.value_or(kNone), distance_error_percent(result)});
  return row;
}

Row attitude_figures(const Result& result) {
  const auto rmse = evaluation::attitude_rmse(result.run, result.recording);
  const auto steps = static_cast<double>(result.run.steps.size());
  if (!rmse) return {kNone, kNone, kNone, steps};
  return {rmse->total_deg, rmse->heading_deg, rmse->inclination_deg, steps};
}

Row attitude_and_position_figures(const Result& result) {
  Row row = attitude_figures(result);
  const auto errors = evaluation::position_errors(result.run, result.recording.truth);
  if (errors) {
    row.insert(row.end(), {errors->path_m, errors->ate_m, errors->start_aligned.mean_m,
                           errors->inside_95_percent.value_or(kNone)});
  } else {
    row.insert(row.end(), 4, kNone);
  }
  return row;
}

Row hourly_figures(const Result& result) {
  const auto steps = static_cast<double>(result.run.steps.size());
  return {steps, result.duration_s / 60.0, steps / (result.duration_s / 3600.0)};
}

}  // namespace vpdr::bench
