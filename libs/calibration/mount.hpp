#pragma once
// Which way a board sits on a person, from standing still and a few steps straight on.
//
// Up is where gravity points at rest. Forward follows from how people walk: with each step the
// trunk goes up and down, and slows down and speeds up, in one rhythm; it sways to the sides at
// half of it. So the horizontal acceleration at the rhythm of the steps lies along forward. The
// trunk is lowest, its acceleration upwards greatest, where it is fastest (both feet on the ground:
// an inverted pendulum), so the forward acceleration is a quarter of a step ahead of the upward
// one.
#include <Eigen/Core>

#include "core/result.hpp"
#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

struct MountConfig {
  double rest_s = 1.0;               ///< shortest standing
  double standing_sigma_mps2 = 0.4;  ///< a standing person is not a table
  double walking_sigma_mps2 = 0.8;   ///< of the force's length, a second of walking
  double min_walking_s = 4.0;        ///< some eight steps
  double min_step_hz = 1.2;
  double max_step_hz = 2.6;
  double levelling_s = 4.0;  ///< time over which the horizon follows the force
  double running_hz = 2.4;   ///< faster steps are a run, whose rhythm is another
  double min_straightness = 0.6;
  double min_lead_rad = 0.35;  ///< nearer to 0 or pi, forward may as well be backward
};

struct Mount {
  Eigen::Matrix3d body_from_board = Eigen::Matrix3d::Identity();  ///< forward, left, up
  double tilt_rad = 0.0;  ///< scatter of up between the standings
  double step_hz = 0.0;
  double walking_s = 0.0;
  /// Share of the step-rhythm's horizontal acceleration that is along forward, 0.5 to 1.
  double straightness = 0.0;
  /// By how much forward acceleration is ahead of upward, radians: pi / 2 by theory.
  double lead_rad = 0.0;
};

/// From corrected streams in board axes. Refuses where nobody stood still or walked, and where the
/// steps do not tell forward from backward.
Result<Mount> estimate_mount(const SensorStreams& streams, const MountConfig& config = {});

}  // namespace vpdr::calibration
