#pragma once
// Tables of recordings: CSV, first column int64 nanoseconds, a header line that decides which
// column is which. Columns are known by name, so their order is free; an unknown one is a fault.
// Not thread-safe; holds views into the text it reads, which must outlive it.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "dataset/read_report.hpp"
#include "dataset/stamp_outliers.hpp"

namespace vpdr::dataset {

/// What a table may hold in one column.
struct CsvColumn {
  enum class Kind : std::uint8_t { kNumber, kText, kIgnored };
  std::vector<std::string_view> names;  ///< without '#' and unit: "w_x", "w_RS_S_x"
  std::vector<std::string_view> units;  ///< allowed in brackets; none given is allowed too
  Kind kind = Kind::kNumber;
  bool required = true;
};

/// Reads rows one by one. Column indices are those of the span given; the stamp is apart.
class CsvReader {
 public:
  /// Reads the header. Throws FileFault for an empty file, a missing header, an unknown or doubled
  /// column, a missing required one, or a unit that is not the column's.
  CsvReader(std::filesystem::path file, std::string_view text, std::span<const CsvColumn> columns);

  enum class Row : std::uint8_t { kEnd, kGood, kTorn, kMalformed };
  /// Goes to the next data row. Empty lines and lines that start with '#' are passed over.
  Row next();

  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] TimestampNs stamp_ns() const { return stamp_ns_; }
  /// Number of the current row; nan where the table has no such column.
  [[nodiscard]] double number(std::size_t column) const { return numbers_[column]; }
  [[nodiscard]] std::string_view text(std::size_t column) const { return texts_[column]; }
  /// Place and reason of the last malformed row.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  static constexpr std::size_t kStamp = static_cast<std::size_t>(-1);

  std::optional<std::string_view> next_line();
  void read_header(std::string_view header);
  void place_header_cell(std::string_view cell, std::size_t at, std::size_t index);
  bool parse_row(std::string_view row);
  bool parse_cell(std::string_view cell, std::size_t column);
  bool complain(std::size_t at, std::string_view what);

  std::filesystem::path file_;
  std::string_view text_;
  std::span<const CsvColumn> columns_;
  std::vector<std::size_t> column_of_cell_;  ///< index into columns_, or kStamp
  std::vector<double> numbers_;
  std::vector<std::string_view> texts_;
  std::size_t position_ = 0;
  std::uint64_t line_ = 0;
  TimestampNs stamp_ns_ = 0;
  std::string problem_;
};

/// Accepts the current row or says why not.
using RowHandler = std::function<std::optional<RowFault>(const CsvReader&)>;

/// Reads a table (plain or xz): every good row with a newer stamp that is no outlier goes to
/// `handle`; the rest is refused and counted. Throws FileFault as CsvReader does, and where every
/// row is malformed or most rows are refused for their form or their stamps.
FileReport read_table(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                      ReadReport& report, const RowHandler& handle, RowsOf rows = RowsOf::kEvents);

}  // namespace vpdr::dataset
