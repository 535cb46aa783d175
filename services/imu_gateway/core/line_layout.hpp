#pragma once
// What the columns of a board's text lines mean:
//
//   t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C
//   =MAG,t_us,mx_G/1090,my_G/1090,-mz_G/1090
//
// A column's name says quantity and unit: t_{s,ms,us,ns}; ax.. {g,mg,mps2}; gx.. {dps,radps};
// mx.. {G,mG,uT,nT}; p_{Pa,hPa,kPa}; temp_C. "-" before it turns the sign, "/1090" or "*0.001"
// after it scales raw counts. "=MAG" is a column that holds the text MAG and nothing else, "skip"
// and names that begin with it are read over. Pure.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "imu_gateway/core/board_parser.hpp"

namespace vpdr::imu_gateway {

/// How the columns of a line are told apart.
enum class Separator : std::uint8_t { kAuto, kComma, kSemicolon, kTab, kSpace };

/// Splits a line into trimmed fields. kAuto: by semicolons, else by commas, else by blanks. kSpace:
/// by blanks and tabs, however many there are.
void split_fields(std::string_view line, Separator separator,
                  std::vector<std::string_view>& fields);

/// A decimal number; a comma stands for the point too. None: anything else is in the field.
std::optional<double> number_in(std::string_view field);

/// One kind of line: for each column where its number goes and by which factor.
class LineLayout {
 public:
  enum class Fit : std::uint8_t {
    kFits,       ///< a line of this kind
    kMalformed,  ///< right number of columns and right texts, but not all numbers can be read
    kOtherKind,  ///< not a line of this kind
  };

  /// Column names in order. Error: the unknown column and what is known.
  static Result<LineLayout> parse(std::string_view columns, Separator separator = Separator::kAuto);

  /// Reads one line's fields into `out`.
  [[nodiscard]] Fit read(std::span<const std::string_view> fields, BoardReadings& out) const;
  /// Whether lines of the other kind cannot be told from lines of this one.
  [[nodiscard]] bool same_shape(const LineLayout& other) const;

 private:
  enum class Quantity : std::uint8_t {
    kSkip,
    kText,
    kTime,
    kForce,
    kRate,
    kField,
    kPressure,
    kTemperature
  };
  struct Column {
    Quantity quantity = Quantity::kSkip;
    int axis = 0;
    double factor = 1.0;
    std::string text;  ///< of kText
  };
  static std::optional<Column> column_of(std::string_view name);
  static std::optional<Column> unit_column(std::string_view name);
  [[nodiscard]] bool has_all(Quantity quantity) const;
  [[nodiscard]] bool texts_match(std::span<const std::string_view> fields) const;

  std::vector<Column> columns_;
  bool has_force_ = false;
  bool has_rate_ = false;
  bool has_field_ = false;
  TimestampNs clock_wraps_at_ns_ = 0;
};

}  // namespace vpdr::imu_gateway
