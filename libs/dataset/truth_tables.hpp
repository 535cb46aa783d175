#pragma once
// The truth a recording carries: reference poses, waypoints, steps, movement marks. Each reader
// appends its FileReport to `report` and throws FileFault as read_table does.
#include <filesystem>
#include <vector>

#include "dataset/read_report.hpp"
#include "dataset/recording.hpp"

namespace vpdr::dataset {

/// groundtruth.csv: position m, attitude sensor to ENU w x y z, either may be nan; EuRoC's columns
/// (p_RS_R_x ..., with velocity and biases, which are not kept) are known too.
std::vector<TruthPose> read_groundtruth_table(const std::filesystem::path& file,
                                              ReadReport& report);

/// TUM: `t_s x y z qx qy qz qw`, blank-separated, '#' comments. Bad rows are refused and counted.
std::vector<TruthPose> read_tum(const std::filesystem::path& file, ReadReport& report);

/// waypoints.csv: x east, y north, m.
std::vector<Waypoint> read_waypoint_table(const std::filesystem::path& file, ReadReport& report);

/// steps.csv: one row a true step; the length may be nan or absent.
std::vector<TrueStep> read_step_table(const std::filesystem::path& file, ReadReport& report);

/// movement.csv: the intervals marked 1; a mark holds until the next row.
std::vector<Interval> read_movement_table(const std::filesystem::path& file, ReadReport& report);

/// reference.json of a Mobilise-D recording (initial contacts and strides of each walking bout), in
/// seconds from `start_ns`. The optical system (Stereophoto) is taken where it saw a bout, else
/// INDIP; contacts at unknown times are left out. Fills steps, strides and walking_bouts.
void read_step_reference(const std::filesystem::path& file, TimestampNs start_ns, Truth& truth,
                         ReadReport& report);

}  // namespace vpdr::dataset
