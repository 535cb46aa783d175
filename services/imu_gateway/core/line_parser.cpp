#include "imu_gateway/core/line_parser.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/rotation.hpp"

namespace vpdr::imu_gateway {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Calls `use` for each field between commas.
template <class Callback>
void for_each_field(std::string_view line, Callback use) {
  while (true) {
    const auto comma = line.find(',');
    use(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number_in(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<LineLayout::Column> LineLayout::column_of(std::string_view name) {
  if (name == "temp_C" || name.starts_with("skip")) return Column{};
  struct Unit {
    std::string_view prefix;
    std::string_view unit;
    Quantity quantity;
    double factor;
  };
  static constexpr double kDegree = kPi / 180.0;
  static constexpr std::array<Unit, 13> kUnits{{{"t", "s", Quantity::kTime, 1e9},
                                                {"t", "ms", Quantity::kTime, 1e6},
                                                {"t", "us", Quantity::kTime, 1e3},
                                                {"t", "ns", Quantity::kTime, 1.0},
                                                {"a", "g", Quantity::kForce, kGravityMps2},
                                                {"a", "mps2", Quantity::kForce, 1.0},
                                                {"g", "dps", Quantity::kRate, kDegree},
                                                {"g", "radps", Quantity::kRate, 1.0},
                                                {"m", "G", Quantity::kField, 100.0},
                                                {"m", "mG", Quantity::kField, 0.1},
                                                {"m", "uT", Quantity::kField, 1.0},
                                                {"p", "Pa", Quantity::kPressure, 1.0},
                                                {"p", "hPa", Quantity::kPressure, 100.0}}};
  const auto underscore = name.find('_');
  if (underscore == std::string_view::npos || underscore == 0) return std::nullopt;
  const std::string_view quantity = name.substr(0, underscore);
  const std::string_view unit = name.substr(underscore + 1);
  for (const Unit& known : kUnits) {
    if (unit != known.unit || quantity.front() != known.prefix.front()) continue;
    const bool scalar = known.quantity == Quantity::kTime || known.quantity == Quantity::kPressure;
    if (scalar && quantity.size() == 1) return Column{known.quantity, 0, known.factor};
    if (scalar || quantity.size() != 2) continue;
    const int axis = quantity[1] - 'x';
    if (axis >= 0 && axis <= 2) return Column{known.quantity, axis, known.factor};
  }
  return std::nullopt;
}

Result<LineLayout> LineLayout::parse(std::string_view columns) {
  LineLayout layout;
  std::string unknown;
  for_each_field(columns, [&](std::string_view name) {
    const auto column = column_of(name);
    if (!column && unknown.empty()) unknown = name.empty() ? "(empty)" : std::string(name);
    layout.columns_.push_back(column.value_or(Column{}));
    if (column && column->quantity == Quantity::kTime) {
      layout.time_unit_ns_ = static_cast<std::int64_t>(column->factor);
    }
  });
  if (!unknown.empty()) {
    return Error{"unknown column " + unknown +
                 "; known are t_s t_ms t_us t_ns, ax_g ax_mps2, gx_dps gx_radps, mx_G mx_mG mx_uT "
                 "(x y z each), p_Pa p_hPa, temp_C, skip"};
  }
  const bool any = layout.has_all(Quantity::kForce) || layout.has_all(Quantity::kField) ||
                   layout.has_all(Quantity::kPressure);
  if (!any) {
    return Error{"\"" + std::string(columns) +
                 "\" has no whole sensor: name ax ay az, mx my mz, or p"};
  }
  return layout;
}

bool LineLayout::has_all(Quantity quantity) const {
  std::array<bool, 3> seen{};
  for (const Column& column : columns_) {
    if (column.quantity == quantity) seen[static_cast<std::size_t>(column.axis)] = true;
  }
  return quantity == Quantity::kPressure ? seen[0] : seen[0] && seen[1] && seen[2];
}

std::optional<std::size_t> LineLayout::time_column() const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].quantity == Quantity::kTime) return i;
  }
  return std::nullopt;
}

LineReadings LineLayout::readings(const std::vector<double>& numbers,
                                  std::optional<TimestampNs> exact_stamp_ns) const {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d field = Eigen::Vector3d::Zero();
  double pressure = 0.0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    const double value = numbers[i] * column.factor;
    if (column.quantity == Quantity::kForce) force[column.axis] = value;
    if (column.quantity == Quantity::kRate) rate[column.axis] = value;
    if (column.quantity == Quantity::kField) field[column.axis] = value;
    if (column.quantity == Quantity::kPressure) pressure = value;
  }
  LineReadings out;
  out.board_stamp_ns = exact_stamp_ns;
  const TimestampNs stamp = exact_stamp_ns.value_or(0);
  const bool has_rate = has_all(Quantity::kRate);
  if (has_all(Quantity::kForce)) out.imu = ImuSample{stamp, force, rate, has_rate};
  if (has_all(Quantity::kField)) out.mag = MagSample{stamp, field};
  if (has_all(Quantity::kPressure)) out.pressure = PressureSample{stamp, pressure};
  return out;
}

LineParser::LineParser(std::vector<LineLayout> layouts) : layouts_(std::move(layouts)) {}

LineVerdict LineParser::adopt_header(std::string_view line) {
  auto layout = LineLayout::parse(line);
  if (!layout) {
    ++malformed_;
    return LineVerdict::kMalformed;
  }
  std::erase_if(layouts_, [&layout](const LineLayout& old) {
    return old.column_count() == layout.value().column_count();
  });
  layouts_.push_back(layout.value());
  return LineVerdict::kHeader;
}

LineVerdict LineParser::parse(std::string_view line, LineReadings& out) {
  line = trimmed(line);
  if (!line.empty() && line.front() == '#') line = trimmed(line.substr(1));
  if (line.empty()) return LineVerdict::kEmpty;
  if (std::isalpha(static_cast<unsigned char>(line.front())) != 0 && !line.starts_with("nan")) {
    return adopt_header(line);
  }
  numbers_.clear();
  bool valid = true;
  for_each_field(line, [&](std::string_view field) {
    const auto number = number_in(field);
    valid = valid && number.has_value();
    numbers_.push_back(number.value_or(0.0));
  });
  if (!valid) {
    ++malformed_;
    return LineVerdict::kMalformed;
  }
  for (const LineLayout& layout : layouts_) {
    if (layout.column_count() != numbers_.size()) continue;
    std::optional<TimestampNs> stamp;
    if (const auto column = layout.time_column()) {
      const double ns = numbers_[*column] * static_cast<double>(layout.time_unit_ns());
      // Beyond 2^62 ns (146 years) it is no board time, and the conversion would be undefined.
      if (!std::isfinite(ns) || std::abs(ns) > 4.6e18) {
        ++malformed_;
        return LineVerdict::kMalformed;
      }
      stamp = static_cast<TimestampNs>(std::llround(ns));
    }
    out = layout.readings(numbers_, stamp);
    return LineVerdict::kReadings;
  }
  ++unknown_layout_;
  return LineVerdict::kUnknownLayout;
}

}  // namespace vpdr::imu_gateway
