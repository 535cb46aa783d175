#pragma once
// Orientation error as the BROAD benchmark defines it (Laidig et al., "BROAD: A Benchmark for
// Robust Inertial Orientation Estimation", Data 6(7):72, 2021): e = q_est * conj(q_ref), both
// sensor to ENU; total 2 acos|e_w|, heading 2 atan|e_z / e_w|, inclination 2 acos sqrt(e_w^2 +
// e_z^2); root mean square over the reference's rows that count.
#include <optional>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// Angles of one error rotation, rad, each in [0, pi].
struct AttitudeError {
  double total_rad = 0.0;
  double heading_rad = 0.0;
  double inclination_rad = 0.0;
};
AttitudeError attitude_error(const Eigen::Quaterniond& world_from_sensor_estimate,
                             const Eigen::Quaterniond& world_from_sensor_reference);

/// Root mean squares over `samples` rows.
struct AttitudeRmse {
  double total_deg = 0.0;
  double heading_deg = 0.0;
  double inclination_deg = 0.0;
  std::uint64_t samples = 0;
  /// The recording has no magnetometer, so its yaw has no zero: the mean heading error was taken
  /// out first.
  bool heading_aligned = false;
};

/// Compares at the truth's stamps (slerp between estimates) where the reference is known, movement
/// counts, and no reference fault is marked. The run's attitudes are body to world; the recording's
/// mount turns them to the sensor's. nullopt where no row can be compared.
std::optional<AttitudeRmse> attitude_rmse(const RunDirectory& run,
                                          const dataset::Recording& recording);

}  // namespace vpdr::evaluation
