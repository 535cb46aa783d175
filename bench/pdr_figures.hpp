#pragma once
// The figures of one walk that pdr has been run over, one row for each kind of truth; NaN where the
// recording does not tell. What the columns mean is told where they are printed.
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::bench {

/// One walk, run.
struct Result {
  const dataset::Recording& recording;
  evaluation::RunDirectory run;
  double duration_s = 0.0;
  double taken_s = 0.0;
  double highest_m = 0.0;  ///< largest height found, up or down
  double floor_changes = 0.0;
};

/// Figures of one recording by column; the mean over the set is printed below them.
using Row = std::vector<double>;

/// Distance from surveyed waypoints, as it is and fitted; honesty of the covariance; step lengths.
Row waypoint_figures(const Result& result);
/// Steps, path, and where it ends, seen from where it began.
Row there_and_back_figures(const Result& result);
/// Steps: true, counted, error.
Row step_figures(const Result& result);
/// Steps as above, then heights, timing and distance.
Row timing_figures(const Result& result);
/// Attitude errors, steps.
Row attitude_figures(const Result& result);
/// Attitude as above, then the position's.
Row attitude_and_position_figures(const Result& result);
/// Steps, minutes, steps an hour.
Row hourly_figures(const Result& result);

}  // namespace vpdr::bench
