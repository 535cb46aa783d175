#pragma once
// A simulated walk: everything a recording has and the truth besides, from one seed.
//
//   WalkOptions options;                        // the two-minute demo walk
//   const SimulatedWalk walk = simulate_walk(options);
//   for (const ImuSample& sample : walk.imu) ...
//   const MotionState truth = walk.state_at(sample.stamp_ns);
//
// World ENU in metres: a drawn walk starts at (0, 0) on a floor at z = 0. Body: the board's
// forward-left-up axes. The same options give the same walk, sample by sample, in every process.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/samples.hpp"
#include "simulation/building.hpp"
#include "simulation/camera.hpp"
#include "simulation/curve.hpp"
#include "simulation/floor_plan.hpp"
#include "simulation/gait.hpp"
#include "simulation/magnetic_field.hpp"
#include "simulation/sensor_errors.hpp"

namespace vpdr::simulation {

struct WalkOptions {
  std::uint64_t seed = 1;
  double duration_s = 120.0;
  Walker walker;
  bool draw_walker = false;  ///< take a random adult instead of `walker`
  WornAt worn = WornAt::kHead;
  Pauses pauses;
  BuildingOptions building;
  /// Corners of the way, east and north; empty: a way through a building drawn from the seed.
  std::vector<Eigen::Vector2d> waypoints_m;
  double corridor_width_m = 2.4;  ///< around given waypoints
  double turn_length_m = 2.6;     ///< of the way, in which a corner is taken
  double imu_rate_hz = 200.0;
  double mag_rate_hz = 100.0;      ///< 0: no magnetometer
  double pressure_rate_hz = 25.0;  ///< 0: no barometer
  double camera_rate_hz = 10.0;    ///< 0: no camera
  double stamp_jitter_s = 0.0;     ///< standard deviation of the sampling instants
  SensorErrors errors;
  MagneticFieldOptions field;
  Camera camera;
  TimestampNs start_ns = 1'700'000'000 * kNsPerSecond;  ///< of the first sample
};

struct SimulatedWalk {
  WalkOptions options;  ///< with the walker that was drawn
  FloorPlan plan;
  Ground ground;                           ///< under the walker
  MotionSpline motion;                     ///< of the board, from time 0 = options.start_ns
  std::vector<Eigen::Vector2d> corners_m;  ///< of the way
  std::vector<TrueStep> steps;
  double distance_m = 0.0;  ///< along the way
  std::vector<ImuSample> imu{};
  std::vector<MagSample> mag{};
  std::vector<PressureSample> pressure{};
  std::vector<TimestampNs> frames{};  ///< stamps of the camera's images

  /// The board's true motion at an instant (clamped to the walk).
  [[nodiscard]] MotionState state_at(TimestampNs stamp_ns) const;
  /// The camera's true pose at an instant.
  [[nodiscard]] Eigen::Isometry3d world_from_camera(TimestampNs stamp_ns) const;
};

/// Makes a walk; a two-minute walk takes a fraction of a second. Throws ConfigurationFault naming
/// the option that makes no sense.
SimulatedWalk simulate_walk(const WalkOptions& options);

}  // namespace vpdr::simulation
