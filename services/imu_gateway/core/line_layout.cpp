#include "imu_gateway/core/line_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr std::string_view kBlanks = " \t";
/// Beyond 2^61 ns (73 years, the year 2043) it is no board time; differences fit into 64 bits.
constexpr double kLatestNs = 2.3e18;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

void split_at_blanks(std::string_view line, std::vector<std::string_view>& fields) {
  while (true) {
    const auto first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return;
    const auto end = std::min(line.find_first_of(kBlanks, first), line.size());
    fields.push_back(line.substr(first, end - first));
    line.remove_prefix(end);
  }
}

void split_at(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  while (true) {
    const auto end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

Separator separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return Separator::kSemicolon;
  if (line.find(',') != std::string_view::npos) return Separator::kComma;
  return Separator::kSpace;
}

std::optional<double> plain_number(std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

}  // namespace

void split_fields(std::string_view line, Separator separator,
                  std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == Separator::kAuto) separator = separator_of(line);
  if (separator == Separator::kComma) split_at(line, ',', fields);
  if (separator == Separator::kSemicolon) split_at(line, ';', fields);
  if (separator == Separator::kTab) split_at(line, '\t', fields);
  if (separator == Separator::kSpace) split_at_blanks(line, fields);
}

std::optional<double> number_in(std::string_view field) {
  const auto comma = field.find(',');
  if (comma == std::string_view::npos) return plain_number(field);
  std::array<char, 40> text{};
  if (field.size() > text.size()) return std::nullopt;
  std::copy(field.begin(), field.end(), text.begin());
  text[comma] = '.';
  return plain_number({text.data(), field.size()});
}

std::optional<LineLayout::Column> LineLayout::unit_column(std::string_view name) {
  struct Unit {
    char quantity_letter;
    std::string_view unit;
    Quantity quantity;
    double factor;
  };
  static constexpr double kDegree = kPi / 180.0;
  static constexpr std::array<Unit, 16> kUnits{{{'t', "s", Quantity::kTime, 1e9},
                                                {'t', "ms", Quantity::kTime, 1e6},
                                                {'t', "us", Quantity::kTime, 1e3},
                                                {'t', "ns", Quantity::kTime, 1.0},
                                                {'a', "g", Quantity::kForce, kGravityMps2},
                                                {'a', "mg", Quantity::kForce, kGravityMps2 * 1e-3},
                                                {'a', "mps2", Quantity::kForce, 1.0},
                                                {'g', "dps", Quantity::kRate, kDegree},
                                                {'g', "radps", Quantity::kRate, 1.0},
                                                {'m', "G", Quantity::kField, 100.0},
                                                {'m', "mG", Quantity::kField, 0.1},
                                                {'m', "uT", Quantity::kField, 1.0},
                                                {'m', "nT", Quantity::kField, 1e-3},
                                                {'p', "Pa", Quantity::kPressure, 1.0},
                                                {'p', "hPa", Quantity::kPressure, 100.0},
                                                {'p', "kPa", Quantity::kPressure, 1000.0}}};
  const auto underscore = name.find('_');
  if (underscore == std::string_view::npos || underscore == 0) return std::nullopt;
  const std::string_view quantity = name.substr(0, underscore);
  const std::string_view unit = name.substr(underscore + 1);
  for (const Unit& known : kUnits) {
    if (unit != known.unit || quantity.front() != known.quantity_letter) continue;
    const bool scalar = known.quantity == Quantity::kTime || known.quantity == Quantity::kPressure;
    if (scalar && quantity.size() == 1) return Column{known.quantity, 0, known.factor, {}};
    if (scalar || quantity.size() != 2) continue;
    const int axis = quantity[1] - 'x';
    if (axis >= 0 && axis <= 2) return Column{known.quantity, axis, known.factor, {}};
  }
  return std::nullopt;
}

std::optional<LineLayout::Column> LineLayout::column_of(std::string_view name) {
  if (name.starts_with("=")) return Column{Quantity::kText, 0, 1.0, std::string(name.substr(1))};
  if (name.starts_with("skip")) return Column{};
  double scale = 1.0;
  if (name.starts_with("-")) {
    scale = -1.0;
    name.remove_prefix(1);
  }
  if (const auto at = name.find_first_of("/*"); at != std::string_view::npos) {
    const auto number = number_in(name.substr(at + 1));
    if (!number || !std::isfinite(*number) || *number == 0.0) return std::nullopt;
    scale = name[at] == '/' ? scale / *number : scale * *number;
    name = name.substr(0, at);
  }
  auto column = name == "temp_C" ? Column{Quantity::kTemperature, 0, 1.0, {}} : unit_column(name);
  if (column) column->factor *= scale;
  return column;
}

Result<LineLayout> LineLayout::parse(std::string_view columns, Separator separator) {
  LineLayout layout;
  std::vector<std::string_view> names;
  split_fields(columns, separator, names);
  for (const std::string_view name : names) {
    auto column = column_of(name);
    if (!column) {
      return Error{"unknown column " + (name.empty() ? "(empty)" : std::string(name)) +
                   "; known are t_s t_ms t_us t_ns, ax_g ax_mg ax_mps2, gx_dps gx_radps, "
                   "mx_G mx_mG mx_uT mx_nT (x y z each), p_Pa p_hPa p_kPa, temp_C, skip, =TEXT; "
                   "-NAME, NAME/16384 and NAME*0.001 scale"};
    }
    // Counters of microseconds and milliseconds are 32 bits wide on nearly every board.
    const bool counter = name == "t_us" || name == "t_ms";
    if (counter) layout.clock_wraps_at_ns_ = static_cast<TimestampNs>(0x1p32 * column->factor);
    layout.columns_.push_back(*std::move(column));
  }
  layout.has_force_ = layout.has_all(Quantity::kForce);
  layout.has_rate_ = layout.has_all(Quantity::kRate);
  layout.has_field_ = layout.has_all(Quantity::kField);
  const bool any = layout.has_force_ || layout.has_rate_ || layout.has_field_ ||
                   layout.has_all(Quantity::kPressure) || layout.has_all(Quantity::kTemperature);
  if (!any) {
    return Error{"\"" + std::string(columns) +
                 "\" has no whole sensor: name ax ay az, gx gy gz, mx my mz, p or temp"};
  }
  return layout;
}

bool LineLayout::has_all(Quantity quantity) const {
  std::array<bool, 3> seen{};
  for (const Column& column : columns_) {
    if (column.quantity == quantity) seen[static_cast<std::size_t>(column.axis)] = true;
  }
  const bool scalar = quantity == Quantity::kPressure || quantity == Quantity::kTemperature;
  return scalar ? seen[0] : seen[0] && seen[1] && seen[2];
}

bool LineLayout::texts_match(std::span<const std::string_view> fields) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].quantity == Quantity::kText && columns_[i].text != fields[i]) return false;
  }
  return true;
}

bool LineLayout::same_shape(const LineLayout& other) const {
  return columns_.size() == other.columns_.size() &&
         std::equal(columns_.begin(), columns_.end(), other.columns_.begin(),
                    [](const Column& a, const Column& b) {
                      return (a.quantity == Quantity::kText) == (b.quantity == Quantity::kText) &&
                             a.text == b.text;
                    });
}

LineLayout::Fit LineLayout::read(std::span<const std::string_view> fields,
                                 BoardReadings& out) const {
  if (fields.size() != columns_.size() || !texts_match(fields)) return Fit::kOtherKind;
  out = {};
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d field = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    if (column.quantity == Quantity::kSkip || column.quantity == Quantity::kText) continue;
    const auto number = number_in(fields[i]);
    if (!number) return Fit::kMalformed;
    const double value = *number * column.factor;
    if (column.quantity == Quantity::kTime) {
      if (!std::isfinite(value) || std::abs(value) > kLatestNs) return Fit::kMalformed;
      out.board_stamp_ns = static_cast<TimestampNs>(std::llround(value));
      out.clock_wraps_at_ns = clock_wraps_at_ns_;
    }
    if (column.quantity == Quantity::kForce) force[column.axis] = value;
    if (column.quantity == Quantity::kRate) rate[column.axis] = value;
    if (column.quantity == Quantity::kField) field[column.axis] = value;
    if (column.quantity == Quantity::kPressure) out.pressure_pa = value;
    if (column.quantity == Quantity::kTemperature) out.temperature_c = value;
  }
  if (has_force_) out.specific_force_mps2 = force;
  if (has_rate_) out.angular_velocity_radps = rate;
  if (has_field_) out.field_ut = field;
  return Fit::kFits;
}

}  // namespace vpdr::imu_gateway
