#pragma once
// What fusion is fed, in one total order: by stamp, then by kind (rate, heading, step), then by
// content. Two runs that see the same measurements apply them in the same order whatever the
// network did to their arrival.
#include <variant>

#include "core/estimates.hpp"

namespace vpdr::fusion {

/// The order of the alternatives is the order of kinds at equal stamps: vision's rate predicts,
/// pdr's heading corrects, the step then walks in the corrected direction.
using Measurement = std::variant<HeadingRate, HeadingEstimate, StepEvent>;

/// The instant at which a measurement is applied: its stamp, but the middle of a step, whose
/// direction is the mean over it.
[[nodiscard]] TimestampNs stamp_of(const Measurement& measurement);

/// Strict total order of finite measurements.
[[nodiscard]] bool comes_before(const Measurement& a, const Measurement& b);

/// Every number finite, deviations positive, lengths and intervals not negative.
[[nodiscard]] bool is_finite(const Measurement& measurement);
[[nodiscard]] bool is_in_range(const Measurement& measurement);

}  // namespace vpdr::fusion
