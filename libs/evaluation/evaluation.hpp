#pragma once
// All errors of a run against whatever truth its recording has.
//
//   const auto recording = dataset::read_recording(folder);
//   const auto run = evaluation::RunDirectory::read(dir);
//   const auto result = evaluation::evaluate(run, recording);
//   std::cout << evaluation::to_table(result);   // or to_json(result)
//
// The recording is as read_recording gives it, in the sensor's axes: its mount relates the run's
// body attitudes to the reference's sensor attitudes. A recording after apply_mount() works too.
#include <optional>
#include <string>

#include "evaluation/attitude_errors.hpp"
#include "evaluation/step_errors.hpp"
#include "evaluation/trajectory_errors.hpp"
#include "evaluation/waypoint_errors.hpp"

namespace vpdr::evaluation {

/// Parts for which the recording has no truth, or none within the run's time, are nullopt.
struct Evaluation {
  std::string recording;
  bool has_truth = false;  ///< whether the recording has any, of whatever time
  Summary summary;
  std::optional<AttitudeRmse> attitude;
  std::optional<StepErrors> steps;
  std::optional<WaypointErrors> waypoints;
  std::optional<PositionErrors> position;
};

Evaluation evaluate(const RunDirectory& run, const dataset::Recording& recording);

/// One JSON object with `attitude_rmse_deg {total, heading, inclination}`, `steps {true, counted,
/// error_percent}`, `waypoints {mean_m, final_m, final_percent, max_m}`, `position {ate_m,
/// rpe_percent, start_aligned {...}, inside_95_percent}`, and more keys inside them. A part without
/// truth is left out; what cannot be computed is null.
std::string to_json(const Evaluation& evaluation);

/// The same for a terminal: one aligned line a figure.
std::string to_table(const Evaluation& evaluation);

}  // namespace vpdr::evaluation
