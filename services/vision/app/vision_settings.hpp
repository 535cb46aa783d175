#pragma once
// Names, ranges and meanings of vision's algorithm settings, bound as `vision.*`.
#include "config/binder.hpp"
#include "vision/core/vanishing_point_heading.hpp"

namespace vpdr::vision {

void bind(config::Binder& binder, VisionConfig& config);

}  // namespace vpdr::vision
