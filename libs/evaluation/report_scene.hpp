#pragma once
// A run and its truth brought into one frame and one time, ready to be drawn.
#include <optional>
#include <string>
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/evaluation.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// One estimated track, in the truth's frame.
struct Track {
  std::vector<StampedPose> poses;
  /// Horizontal distance to the truth over time; at the truth's stamps or at the waypoints.
  std::vector<double> error_time_s;
  std::vector<double> error_m;
  double yaw_shift_rad = 0.0;  ///< what alignment turned it by
};

/// What the figures draw. Times are seconds since `start_ns`.
struct ReportScene {
  const RunDirectory& run;
  const dataset::Recording* recording;  ///< nullptr where it is not at hand
  TimestampNs start_ns = 0;
  double end_s = 1.0;
  Track fused;
  Track pdr;
  std::vector<StampedCovariance> covariance;       ///< of fused, turned with it
  std::vector<dataset::TruthPose> truth;           ///< with a known position
  std::vector<dataset::TruthPose> truth_attitude;  ///< body to world, known
  std::vector<dataset::Waypoint> waypoints;
  std::string alignment;  ///< how the estimates were brought to the truth, a sentence

  [[nodiscard]] double seconds(TimestampNs stamp_ns) const {
    return to_seconds(stamp_ns - start_ns);
  }
};

/// The estimates are moved to the truth's start (or to the first waypoint); where the recording has
/// no magnetometer their yaw has no zero, and they are fitted in yaw and position instead. `run`
/// and `recording` must outlive the scene.
ReportScene make_scene(const RunDirectory& run, const dataset::Recording* recording);

}  // namespace vpdr::evaluation
