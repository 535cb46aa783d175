#pragma once
// Samples of every kind in the one order in which the filters see them.
#include <variant>
#include <vector>

#include "core/samples.hpp"

namespace vpdr {

/// Any sample of the board. At equal stamps the alternatives go in this order, so that an attitude
/// update finds the field that was measured with it.
using Reading = std::variant<MagSample, PressureSample, ImuSample>;

inline TimestampNs stamp_of(const Reading& reading) {
  return std::visit([](const auto& sample) { return sample.stamp_ns; }, reading);
}

/// Merges streams, each in stamp order already, into stamp order; equal stamps as told above.
std::vector<Reading> merge_by_stamp(const std::vector<ImuSample>& imu,
                                    const std::vector<MagSample>& mag,
                                    const std::vector<PressureSample>& pressure);

}  // namespace vpdr
