#pragma once
// Text lines of simple boards, such as STM32 or Arduino sketches with MPU6050 and HMC5883L:
//
//   t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C
//   0.008463,0.052002,-0.182617,-1.01074,10.084,6.98473,-5.32061,24.7653
//
// A column's name says quantity and unit: t_{s,ms,us,ns}; ax.. {g,mps2}; gx.. {dps,radps};
// mx.. {G,mG,uT}; p_{Pa,hPa}; temp_C and other names starting with "skip" are read over. A board
// may send several kinds of line, told apart by their number of columns, and may announce them by
// header lines like the first one above. Pure; a parser belongs to one thread.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/samples.hpp"

namespace vpdr::imu_gateway {

/// What one line held. Stamps are the board's own; absent when the line has no time column.
struct LineReadings {
  std::optional<TimestampNs> board_stamp_ns;
  std::optional<ImuSample> imu;
  std::optional<MagSample> mag;
  std::optional<PressureSample> pressure;
};

/// Why a line gave nothing.
enum class LineVerdict : std::uint8_t { kReadings, kHeader, kEmpty, kMalformed, kUnknownLayout };

/// One kind of line: for each column where its number goes and by which factor.
class LineLayout {
 public:
  /// Columns separated by commas. Error: the unknown column, and the nearest known one.
  static Result<LineLayout> parse(std::string_view columns);

  [[nodiscard]] std::size_t column_count() const { return columns_.size(); }
  /// Numbers in column order to readings. All must be finite for the sensor they belong to.
  [[nodiscard]] LineReadings readings(const std::vector<double>& numbers,
                                      std::optional<TimestampNs> exact_stamp_ns) const;
  /// Index of the time column.
  [[nodiscard]] std::optional<std::size_t> time_column() const;
  /// Nanoseconds in one unit of the time column; 0 without one.
  [[nodiscard]] std::int64_t time_unit_ns() const { return time_unit_ns_; }

 private:
  enum class Quantity : std::uint8_t { kSkip, kTime, kForce, kRate, kField, kPressure };
  struct Column {
    Quantity quantity = Quantity::kSkip;
    int axis = 0;
    double factor = 1.0;
  };
  static std::optional<Column> column_of(std::string_view name);
  [[nodiscard]] bool has_all(Quantity quantity) const;

  std::vector<Column> columns_;
  std::int64_t time_unit_ns_ = 0;
};

/// Parses the lines of one board and counts what it could not read.
class LineParser {
 public:
  explicit LineParser(std::vector<LineLayout> layouts);

  /// `line` without its end of line. Fills `out` and returns kReadings, or says why not.
  LineVerdict parse(std::string_view line, LineReadings& out);

  [[nodiscard]] std::uint64_t malformed() const { return malformed_; }
  [[nodiscard]] std::uint64_t unknown_layout() const { return unknown_layout_; }

 private:
  LineVerdict adopt_header(std::string_view line);

  std::vector<LineLayout> layouts_;
  std::vector<double> numbers_;
  std::uint64_t malformed_ = 0;
  std::uint64_t unknown_layout_ = 0;
};

/// Splits a byte stream into lines, in bounded memory: an overlong line is dropped and counted.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_line = 512) : max_line_(max_line) {}

  /// Calls `line(std::string_view)` for each whole line in `bytes` and what came before.
  template <class Callback>
  void feed(std::string_view bytes, Callback line) {
    for (char c : bytes) {
      if (c == '\n' || c == '\r') {
        if (!overlong_ && !buffer_.empty()) line(std::string_view(buffer_));
        overlong_ = false;
        buffer_.clear();
      } else if (overlong_ || buffer_.size() == max_line_) {
        if (!overlong_) ++overlong_lines_;
        overlong_ = true;
      } else {
        buffer_ += c;
      }
    }
  }
  /// Forgets a half-read line, as after a reconnection.
  void reset() {
    buffer_.clear();
    overlong_ = false;
  }
  [[nodiscard]] std::uint64_t overlong_lines() const { return overlong_lines_; }

 private:
  std::size_t max_line_;
  std::string buffer_;
  bool overlong_ = false;
  std::uint64_t overlong_lines_ = 0;
};

}  // namespace vpdr::imu_gateway
