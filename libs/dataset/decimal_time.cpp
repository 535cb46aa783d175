#include "dataset/decimal_time.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vpdr::dataset {
namespace {

constexpr double kLargestSeconds = 9.2e9;  // just inside int64 nanoseconds

std::optional<TimestampNs> parse_with_exponent(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (!(std::abs(value) < kLargestSeconds)) return std::nullopt;
  return to_ns(value);
}

bool all_digits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Nanoseconds of the digits behind the point, rounded.
std::int64_t fraction_ns(std::string_view digits) {
  std::int64_t value = 0;
  for (std::size_t i = 0; i < 9; ++i)
    value = value * 10 + (i < digits.size() ? digits[i] - '0' : 0);
  return digits.size() > 9 && digits[9] >= '5' ? value + 1 : value;
}

}  // namespace

std::optional<TimestampNs> parse_decimal_seconds(std::string_view text) {
  if (text.find_first_of("eE") != std::string_view::npos) return parse_with_exponent(text);
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  const std::string_view part = point == text.npos ? std::string_view{} : text.substr(point + 1);
  if ((whole.empty() && part.empty()) || !all_digits(whole) || !all_digits(part)) {
    return std::nullopt;
  }
  std::int64_t seconds = 0;
  if (!whole.empty()) {
    const auto result = std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
    if (result.ec != std::errc{}) return std::nullopt;
  }
  if (static_cast<double>(seconds) >= kLargestSeconds) return std::nullopt;
  const TimestampNs magnitude = seconds * kNsPerSecond + fraction_ns(part);
  return negative ? -magnitude : magnitude;
}

std::string format_decimal_seconds(TimestampNs stamp_ns) {
  const bool negative = stamp_ns < 0;
  const std::uint64_t magnitude =
      negative ? ~static_cast<std::uint64_t>(stamp_ns) + 1 : static_cast<std::uint64_t>(stamp_ns);
  const std::string fraction = std::to_string(magnitude % 1'000'000'000);
  return (negative ? "-" : "") + std::to_string(magnitude / 1'000'000'000) + "." +
         std::string(9 - fraction.size(), '0') + fraction;
}

}  // namespace vpdr::dataset
