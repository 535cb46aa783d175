#include "evaluation/headline.hpp"

#include "evaluation/plot.hpp"
#include "evaluation/svg.hpp"

namespace vpdr::evaluation {
namespace {

void add_position(const PositionErrors& position, std::vector<Headline>& list) {
  const StartAlignedErrors& start = position.start_aligned;
  list.push_back({"position error at the end", fixed_number(start.final_m, 2), "m",
                  fixed_number(start.final_percent, 2) + " % of " +
                      fixed_number(position.path_m, 1) + " m; mean " +
                      fixed_number(start.mean_m, 2) + " m"});
  std::string more = "fitted in yaw and position";
  if (position.rpe_percent) more += "; RPE " + fixed_number(*position.rpe_percent, 2) + " %";
  list.push_back({"trajectory error (ATE)", fixed_number(position.ate_m, 2), "m", more});
  if (!position.inside_95_percent) return;
  list.push_back({"truth inside the 95 % ellipse", fixed_number(*position.inside_95_percent, 1),
                  "%", "of the time, from the true start"});
}

void add_waypoints(const WaypointErrors& waypoints, std::vector<Headline>& list) {
  list.push_back({"mean waypoint error", fixed_number(waypoints.mean_m, 2), "m",
                  "at the end " + fixed_number(waypoints.final_m, 2) + " m, " +
                      fixed_number(waypoints.final_percent, 1) + " % of " +
                      fixed_number(waypoints.path_m, 0) + " m"});
}

void add_attitude(const AttitudeRmse& attitude, std::vector<Headline>& list) {
  list.push_back({"attitude RMSE", fixed_number(attitude.total_deg, 2), "\u00b0",
                  "heading " + fixed_number(attitude.heading_deg, 2) + "\u00b0" +
                      (attitude.heading_aligned ? " (aligned)" : "") + ", inclination " +
                      fixed_number(attitude.inclination_deg, 2) + "\u00b0"});
}

}  // namespace

std::vector<Headline> headlines(const Evaluation& evaluation, const RunInfo& info) {
  const Summary& summary = evaluation.summary;
  std::vector<Headline> list;
  if (evaluation.position) add_position(*evaluation.position, list);
  if (evaluation.waypoints) add_waypoints(*evaluation.waypoints, list);
  if (evaluation.attitude) add_attitude(*evaluation.attitude, list);
  Headline steps{"steps", std::to_string(summary.steps), "", ""};
  if (evaluation.steps) {
    steps.value = std::to_string(evaluation.steps->counted);
    steps.more = std::to_string(evaluation.steps->truth) + " true, error " +
                 fixed_number(evaluation.steps->error_percent, 1) + " %";
  }
  list.push_back(steps);
  list.push_back({"distance walked", fixed_number(summary.distance_m, 1), "m",
                  "in " + fixed_number(summary.duration_s, 1) + " s"});
  if (!info.latencies.empty() && info.latencies.front().count > 0) {
    const LatencyReport& latency = info.latencies.front();
    list.push_back({"latency, median", duration_label(latency.p50_us), "",
                    "p99 " + duration_label(latency.p99_us) + "; " + std::to_string(latency.lost) +
                        " of " + std::to_string(latency.count + latency.lost) + " lost"});
  }
  if (summary.speed_factor > 0.0) {
    list.push_back({"speed", fixed_number(summary.speed_factor, summary.speed_factor < 10 ? 1 : 0),
                    "\u00d7", "real time"});
  }
  return list;
}

}  // namespace vpdr::evaluation
