#pragma once
// The keys of the attitude filter, pdr.attitude.*: the largest part of pdr's configuration.
#include "config/binder.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"

namespace vpdr::pdr {

void bind(config::Binder& binder, AttitudeConfig& config);

}  // namespace vpdr::pdr
