#pragma once
// Names, ranges and meanings of visual odometry's settings, bound as `vision.odometry.*` and
// `vision.features.*`.
#include "config/binder.hpp"
#include "vision/core/odometry/visual_odometry.hpp"

namespace vpdr::vision {

void bind_odometry(config::Binder& binder, OdometryConfig& config);

}  // namespace vpdr::vision
