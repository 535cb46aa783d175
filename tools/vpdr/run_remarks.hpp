#pragma once
// What a run did without, in words: a result must not look whole where half of it was refused.
#include <string>
#include <vector>

#include "dataset/recording.hpp"
#include "vpdr/pipeline.hpp"

namespace vpdr::tool {

/// Mistakes of unit, range, sign or axes that the samples (in body axes) tell themselves, as
/// imu_gateway finds them: a line each, with the remedy.
std::vector<std::string> sensor_remarks(const dataset::Recording& recording);

/// Before it, a line each: what about.yaml says and nobody understands.
std::vector<std::string> about_remarks(const dataset::About& about);

/// After the run, a line each: sensors of which no reading was used, frames that were refused.
std::vector<std::string> unused_remarks(const Pipeline& pipeline);

}  // namespace vpdr::tool
