#pragma once
// Which way a sensor's axes point on the body. Board and vendor axes are turned here and nowhere
// else.
#include <Eigen/Core>
#include <string>

#include "core/result.hpp"

namespace vpdr::imu_gateway {

/// Signed permutation from three names, one for each target axis: "+y,-x,+z" says that the target's
/// first axis is the sensor's +y, its second -x, its third +z. Left-handed maps are allowed only
/// with `allow_mirror`, for boards whose vendor flipped a sign. Error: what is wrong and an
/// example.
Result<Eigen::Matrix3d> parse_axis_map(const std::string& names, bool allow_mirror);

}  // namespace vpdr::imu_gateway
