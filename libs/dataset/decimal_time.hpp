#pragma once
// Times written as decimal seconds (TUM files), exact to the nanosecond: a double holds no more
// than about 200 ns of a time since 1970.
#include <optional>
#include <string>
#include <string_view>

#include "core/time.hpp"

namespace vpdr::dataset {

/// Nanoseconds of "1403636580.83856", rounded at the tenth decimal; nullopt where it is no number
/// or does not fit. An exponent is taken too, through a double.
std::optional<TimestampNs> parse_decimal_seconds(std::string_view text);

/// "1403636580.838560000": nine decimals, so that parsing gives the stamp again.
std::string format_decimal_seconds(TimestampNs stamp_ns);

}  // namespace vpdr::dataset
