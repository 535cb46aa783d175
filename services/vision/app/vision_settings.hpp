#pragma once
// Names, ranges and meanings of vision's algorithm settings, bound as `vision.*`.
#include "config/binder.hpp"
#include "vision/core/frame_analysis.hpp"

namespace vpdr::vision {

void bind(config::Binder& binder, AnalysisConfig& config);

}  // namespace vpdr::vision
