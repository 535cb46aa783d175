#pragma once
// Names, ranges and meanings of pdr's configuration, bound as `pdr.*`.
#include "config/binder.hpp"
#include "pdr/core/pdr.hpp"

namespace vpdr::pdr {

void bind(config::Binder& binder, PdrConfig& config);

}  // namespace vpdr::pdr
