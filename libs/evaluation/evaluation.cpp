#include "evaluation/evaluation.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace vpdr::evaluation {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const AttitudeRmse& attitude) {
  return {{"total", attitude.total_deg},
          {"heading", attitude.heading_deg},
          {"inclination", attitude.inclination_deg},
          {"samples", attitude.samples},
          {"heading_aligned", attitude.heading_aligned}};
}

Json json_of(const StepErrors& steps) {
  Json json = {
      {"true", steps.truth}, {"counted", steps.counted}, {"error_percent", steps.error_percent}};
  if (!steps.timing) return json;
  const StepTiming& timing = *steps.timing;
  json["timing"] = {{"matched", timing.matched},
                    {"recall_percent", timing.recall_percent},
                    {"precision_percent", timing.precision_percent},
                    {"mean_offset_s", timing.mean_offset_s},
                    {"sigma_s", timing.sigma_s},
                    {"length_bias_percent", or_null(timing.length_bias_percent)},
                    {"length_rmse_m", or_null(timing.length_rmse_m)}};
  return json;
}

Json json_of(const WaypointErrors& waypoints) {
  return {{"mean_m", waypoints.mean_m},
          {"final_m", waypoints.final_m},
          {"final_percent", waypoints.final_percent},
          {"max_m", waypoints.max_m},
          {"path_m", waypoints.path_m},
          {"count", waypoints.each_m.size()}};
}

Json json_of(const PositionErrors& position) {
  const StartAlignedErrors& start = position.start_aligned;
  return {{"ate_m", position.ate_m},
          {"rpe_percent", or_null(position.rpe_percent)},
          {"rpe_segment_m", position.segment_m},
          {"path_m", position.path_m},
          {"start_aligned",
           {{"mean_m", start.mean_m},
            {"max_m", start.max_m},
            {"final_m", start.final_m},
            {"final_percent", start.final_percent}}},
          {"inside_95_percent", or_null(position.inside_95_percent)},
          {"poses", position.poses}};
}

/// Lines "name   value", aligned.
class Table {
 public:
  [[gnu::format(printf, 3, 4)]] void row(const char* name, const char* format, ...) {
    std::array<char, 200> value{};
    va_list arguments;
    va_start(arguments, format);
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): va_start is just above
    std::vsnprintf(value.data(), value.size(), format, arguments);
    va_end(arguments);
    std::array<char, 300> line{};
    std::snprintf(line.data(), line.size(), "  %-28s %s\n", name, value.data());
    text_ += line.data();
  }
  void heading(const std::string& text) { text_ += text + "\n"; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_steps(Table& table, const StepErrors& steps) {
  table.row("steps", "%llu counted, %llu true, error %.1f %%",
            static_cast<unsigned long long>(steps.counted),
            static_cast<unsigned long long>(steps.truth), steps.error_percent);
  if (!steps.timing) return;
  table.row("step instants", "%.1f %% found, %.1f %% right, offset %+.0f ms, sigma %.0f ms",
            steps.timing->recall_percent, steps.timing->precision_percent,
            1e3 * steps.timing->mean_offset_s, 1e3 * steps.timing->sigma_s);
  if (steps.timing->length_bias_percent) {
    table.row("step length", "bias %+.1f %%, RMSE %.3f m", *steps.timing->length_bias_percent,
              *steps.timing->length_rmse_m);
  }
}

void add_position(Table& table, const PositionErrors& position) {
  const StartAlignedErrors& start = position.start_aligned;
  table.row("position, from the start", "mean %.2f m, max %.2f m, final %.2f m (%.2f %% of %.1f m)",
            start.mean_m, start.max_m, start.final_m, start.final_percent, position.path_m);
  table.row("position, aligned (ATE)", "%.3f m", position.ate_m);
  if (position.rpe_percent) {
    table.row("relative error (RPE)", "%.2f %% over segments of %.1f m", *position.rpe_percent,
              position.segment_m);
  }
  if (position.inside_95_percent) {
    table.row("truth in the 95 % ellipse", "%.1f %% of the time", *position.inside_95_percent);
  }
}

}  // namespace

Evaluation evaluate(const RunDirectory& run, const dataset::Recording& recording) {
  Evaluation evaluation;
  evaluation.recording = recording.name;
  evaluation.summary = run.summary;
  const dataset::Truth& truth = recording.truth;
  evaluation.has_truth = !truth.poses.empty() || !truth.waypoints.empty() || !truth.steps.empty() ||
                         !truth.strides.empty() || recording.about.true_steps;
  evaluation.attitude = attitude_rmse(run, recording);
  evaluation.steps = step_errors(run, recording);
  evaluation.waypoints = waypoint_errors(run.fused, recording.truth.waypoints);
  evaluation.position = position_errors(run, recording.truth);
  return evaluation;
}

std::string to_json(const Evaluation& evaluation) {
  Json json;
  json["recording"] = evaluation.recording;
  json["summary"] = {{"steps", evaluation.summary.steps},
                     {"distance_m", evaluation.summary.distance_m},
                     {"duration_s", evaluation.summary.duration_s},
                     {"speed_factor", evaluation.summary.speed_factor}};
  if (evaluation.attitude) json["attitude_rmse_deg"] = json_of(*evaluation.attitude);
  if (evaluation.steps) json["steps"] = json_of(*evaluation.steps);
  if (evaluation.waypoints) json["waypoints"] = json_of(*evaluation.waypoints);
  if (evaluation.position) json["position"] = json_of(*evaluation.position);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const Evaluation& evaluation) {
  Table table;
  table.heading(evaluation.recording);
  table.row("walked", "%.1f m in %.1f s, %llu steps", evaluation.summary.distance_m,
            evaluation.summary.duration_s,
            static_cast<unsigned long long>(evaluation.summary.steps));
  table.row("speed", "%.1f times real time", evaluation.summary.speed_factor);
  if (evaluation.attitude) {
    table.row("attitude RMSE", "total %.2f deg, heading %.2f deg%s, inclination %.2f deg",
              evaluation.attitude->total_deg, evaluation.attitude->heading_deg,
              evaluation.attitude->heading_aligned ? " (aligned)" : "",
              evaluation.attitude->inclination_deg);
  }
  if (evaluation.steps) add_steps(table, *evaluation.steps);
  if (evaluation.waypoints) {
    table.row("waypoints", "mean %.2f m, max %.2f m, final %.2f m (%.2f %% of %.1f m)",
              evaluation.waypoints->mean_m, evaluation.waypoints->max_m,
              evaluation.waypoints->final_m, evaluation.waypoints->final_percent,
              evaluation.waypoints->path_m);
  }
  if (evaluation.position) add_position(table, *evaluation.position);
  const bool any =
      evaluation.attitude || evaluation.steps || evaluation.waypoints || evaluation.position;
  if (!any) {
    table.row("truth", "%s",
              evaluation.has_truth
                  ? "none within the run's time; is it the recording this run was made from?"
                  : "the recording has none");
  }
  return table.text();
}

}  // namespace vpdr::evaluation
