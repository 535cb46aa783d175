#pragma once
// A reference path made consistent with its gyroscope. An optical reference has its own noise from
// pose to pose, and jumps where a marker is mistaken; a camera that followed it would shake as the
// gyroscope says it does not.
#include <vector>

#include "core/samples.hpp"
#include "simulation/reference_path.hpp"

namespace vpdr::simulation {

struct SmoothingOptions {
  double attitude_window_s = 0.3;     ///< over which the gyroscope is trusted, standard deviation
  double position_window_s = 0.04;    ///< over which the path is a parabola, standard deviation
  double attitude_noise_rad = 0.002;  ///< of a pose; what is off by much more counts little
  double position_noise_m = 0.001;
};

/// Attitude: the gyroscope's turn, carried by the mean of what the poses around an instant say it
/// is off by. Position: a parabola fitted to the poses around it. Poses far off count little
/// (Cauchy's weights), and those whose attitude is far off count little for the position too. One
/// pose at each of the path's instants that lies between inertial samples; the samples are in the
/// axes of the path's body. Without rates the path stays as it is.
ReferencePath smooth_with_gyroscope(const ReferencePath& path, const std::vector<ImuSample>& imu,
                                    const SmoothingOptions& options = {});

}  // namespace vpdr::simulation
