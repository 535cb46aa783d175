#pragma once
// Single wrong stamps in a table: a byte that was damaged, a row written before the clock was set.
#include <cstdint>
#include <span>
#include <vector>

#include "core/time.hpp"

namespace vpdr::dataset {

/// Samples come at a rate; events (steps, waypoints, truth) when they will.
enum class RowsOf : std::uint8_t { kSamples, kEvents };

/// Which of these stamps, in the order of the file, lie far off while those after them go on as if
/// they were not there: ahead of rows that fall back behind them; of samples also alone before or
/// after all others. Believing one would make every row after it look old. A gap after which the
/// clock goes on is none; stamps that go back are not marked either.
std::vector<bool> stamp_outliers(std::span<const TimestampNs> stamps, RowsOf rows);

}  // namespace vpdr::dataset
