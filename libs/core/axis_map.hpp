#pragma once
// Which way a sensor's axes point: signed permutations, by name and as matrices. Pure.
#include <Eigen/Core>
#include <string>

#include "core/result.hpp"

namespace vpdr {

/// Signed permutation from three names, one for each target axis: "+y,-x,+z" says that the target's
/// first axis is the sensor's +y, its second -x, its third +z. Left-handed maps are allowed only
/// with `allow_mirror`, for boards whose vendor flipped a sign. Error: what is wrong and an
/// example.
Result<Eigen::Matrix3d> parse_axis_map(const std::string& names, bool allow_mirror);

/// The signed permutation nearest to a matrix: which axis is which, and which way it points.
Eigen::Matrix3d nearest_axis_map(const Eigen::Matrix3d& matrix);

/// "+y,-x,+z": the names of which parse_axis_map makes the signed permutation `map`.
std::string axis_map_name(const Eigen::Matrix3d& map);

}  // namespace vpdr
