#pragma once
// Names, ranges and meanings of fusion's configuration, bound as `fusion.*`.
#include "config/binder.hpp"
#include "fusion/core/fusion_config.hpp"

namespace vpdr::fusion {

void bind(config::Binder& binder, FusionConfig& config);

}  // namespace vpdr::fusion
