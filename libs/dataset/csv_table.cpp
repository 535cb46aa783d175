#include "dataset/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "dataset/stamp_outliers.hpp"
#include "dataset/text_file.hpp"

namespace vpdr::dataset {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string quoted(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

/// "w_x [rad/s]" -> name "w_x", unit "rad/s". The unit may be followed by words in parentheses.
struct HeaderCell {
  std::string_view name;
  std::string_view unit;
};

HeaderCell split_header(std::string_view cell) {
  cell = trimmed(cell);
  const auto end = cell.find_first_of("[(");
  HeaderCell result{trimmed(cell.substr(0, end)), {}};
  const auto open = cell.find('[');
  const auto close = cell.find(']');
  if (open != std::string_view::npos && close != std::string_view::npos && close > open) {
    result.unit = trimmed(cell.substr(open + 1, close - open - 1));
  }
  return result;
}

std::string known_names(std::span<const CsvColumn> columns) {
  std::string text = "timestamp";
  for (const CsvColumn& column : columns) {
    if (column.kind != CsvColumn::Kind::kIgnored) text += " " + std::string(column.names.front());
  }
  return text;
}

/// Calls visit(cell, character position from 1, index) for each comma-separated cell.
template <class Visit>
void for_each_cell(std::string_view line, Visit visit) {
  std::size_t begin = 0;
  for (std::size_t index = 0;; ++index) {
    const std::size_t end = line.find(',', begin);
    if (!visit(line.substr(begin, end - begin), begin + 1, index)) return;
    if (end == std::string_view::npos) return;
    begin = end + 1;
  }
}

bool contains(const std::vector<std::string_view>& list, std::string_view item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

CsvReader::CsvReader(std::filesystem::path file, std::string_view text,
                     std::span<const CsvColumn> columns)
    : file_(std::move(file)),
      text_(text),
      columns_(columns),
      numbers_(columns.size(), std::numeric_limits<double>::quiet_NaN()),
      texts_(columns.size()) {
  std::optional<std::string_view> header = next_line();
  while (header && trimmed(*header).empty()) header = next_line();
  if (!header) {
    throw fault_at(file_, 1, 1, "the file is empty", "expected a header line and rows");
  }
  read_header(*header);
}

std::optional<std::string_view> CsvReader::next_line() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = text_.substr(position_, end - position_);
  position_ = end + 1;
  ++line_;
  return line;
}

void CsvReader::read_header(std::string_view header) {
  const std::string_view start = trimmed(header);
  if (start.find_first_of("0123456789-+.") == 0) {
    throw fault_at(file_, line_, 1, "no header line",
                   "put one first: '#timestamp [ns]' and " + known_names(columns_));
  }
  const std::size_t hash = header.find('#');
  const std::size_t shift =
      hash != std::string_view::npos && trimmed(header.substr(0, hash)).empty() ? hash + 1 : 0;
  for_each_cell(header.substr(shift), [&](std::string_view cell, std::size_t at, std::size_t i) {
    place_header_cell(cell, at + shift, i);
    return true;
  });
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool found =
        std::find(column_of_cell_.begin(), column_of_cell_.end(), i) != column_of_cell_.end();
    if (columns_[i].required && !found) {
      throw fault_at(file_, line_, 1, "column " + quoted(columns_[i].names.front()) + " is missing",
                     "this table has " + known_names(columns_));
    }
  }
}

void CsvReader::place_header_cell(std::string_view cell, std::size_t at, std::size_t index) {
  const HeaderCell parts = split_header(cell);
  if (index == 0) {
    if (!parts.name.starts_with("timestamp") || !(parts.unit.empty() || parts.unit == "ns")) {
      throw fault_at(file_, line_, at, "first column is " + quoted(trimmed(cell)),
                     "it must be 'timestamp [ns]'");
    }
    column_of_cell_.push_back(kStamp);
    return;
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!contains(columns_[i].names, parts.name)) continue;
    if (std::find(column_of_cell_.begin(), column_of_cell_.end(), i) != column_of_cell_.end() &&
        columns_[i].kind != CsvColumn::Kind::kIgnored) {
      throw fault_at(file_, line_, at, "column " + quoted(parts.name) + " comes twice",
                     "remove one");
    }
    if (!parts.unit.empty() && !columns_[i].units.empty() &&
        !contains(columns_[i].units, parts.unit)) {
      throw fault_at(file_, line_, at,
                     "column " + quoted(parts.name) + " has unit " + quoted(parts.unit),
                     "convert it to [" + std::string(columns_[i].units.front()) + "] and say so");
    }
    column_of_cell_.push_back(i);
    return;
  }
  throw fault_at(file_, line_, at, "unknown column " + quoted(trimmed(cell)),
                 "remove or rename it; this table has " + known_names(columns_));
}

CsvReader::Row CsvReader::next() {
  while (const std::optional<std::string_view> line = next_line()) {
    const std::string_view row = trimmed(*line);
    if (row.empty() || row.front() == '#') continue;
    if (parse_row(row)) return Row::kGood;
    const bool last_without_newline = position_ > text_.size();
    return last_without_newline ? Row::kTorn : Row::kMalformed;
  }
  return Row::kEnd;
}

bool CsvReader::parse_row(std::string_view row) {
  std::size_t cells = 0;
  bool good = true;
  for_each_cell(row, [&](std::string_view cell, std::size_t at, std::size_t index) {
    cells = index + 1;
    if (index >= column_of_cell_.size()) return true;
    good = parse_cell(trimmed(cell), column_of_cell_[index]) ||
           complain(at, quoted(trimmed(cell)) + (column_of_cell_[index] == kStamp
                                                     ? " is no stamp in whole nanoseconds"
                                                     : " is no number"));
    return good;
  });
  if (good && cells != column_of_cell_.size()) {
    return complain(1, std::to_string(cells) + " cells, the header has " +
                           std::to_string(column_of_cell_.size()));
  }
  return good;
}

bool CsvReader::parse_cell(std::string_view cell, std::size_t column) {
  const char* const begin = cell.data();
  const char* const end = begin + cell.size();
  if (column == kStamp) {
    const auto result = std::from_chars(begin, end, stamp_ns_);
    return result.ec == std::errc{} && result.ptr == end;
  }
  switch (columns_[column].kind) {
    case CsvColumn::Kind::kIgnored:
      return true;
    case CsvColumn::Kind::kText:
      texts_[column] = cell;
      return !cell.empty();
    case CsvColumn::Kind::kNumber:
      break;
  }
  const char* const number = cell.starts_with('+') ? begin + 1 : begin;
  const auto result = std::from_chars(number, end, numbers_[column]);
  return result.ec == std::errc{} && result.ptr == end;
}

bool CsvReader::complain(std::size_t at, std::string_view what) {
  problem_ = file_.string() + ":" + std::to_string(line_) + ":" + std::to_string(at) + ": ";
  problem_ += what;
  return false;
}

namespace {

std::optional<RowFault> judge_stamp(TimestampNs stamp_ns, std::optional<TimestampNs> last_ns) {
  if (!last_ns || stamp_ns > *last_ns) return std::nullopt;
  return stamp_ns == *last_ns ? RowFault::kDuplicate : RowFault::kBackward;
}

/// By the number of the well-formed row.
std::vector<bool> outliers_of(CsvReader reader, RowsOf rows) {
  std::vector<TimestampNs> stamps;
  for (auto row = reader.next(); row != CsvReader::Row::kEnd; row = reader.next()) {
    if (row == CsvReader::Row::kGood) stamps.push_back(reader.stamp_ns());
  }
  return stamp_outliers(stamps, rows);
}

/// What would be left of such a table is not what was recorded.
void require_most(const FileReport& result) {
  if (result.rows > 0 && result.refused(RowFault::kMalformed) == result.rows) {
    throw FileFault(result.first_malformed + "; no row of the file can be read: check its format");
  }
  // Readings that are repeated with their stamp are no fault; seconds taken for nanoseconds are.
  const FaultLines& repeated = result.faults[static_cast<std::size_t>(RowFault::kDuplicate)];
  if (10 * repeated.count > 9 * result.rows) {
    throw fault_at(result.file, repeated.first_lines.front(), 1,
                   std::to_string(repeated.count) + " of " + std::to_string(result.rows) +
                       " rows repeat the stamp before",
                   "the first column is in whole nanoseconds");
  }
  std::uint64_t bad = 0;
  std::uint64_t first_line = std::numeric_limits<std::uint64_t>::max();
  for (const RowFault fault : {RowFault::kMalformed, RowFault::kBackward, RowFault::kOutlier}) {
    const FaultLines& lines = result.faults[static_cast<std::size_t>(fault)];
    bad += lines.count;
    if (lines.count > 0) first_line = std::min(first_line, lines.first_lines.front());
  }
  if (2 * bad <= result.rows) return;
  throw fault_at(result.file, first_line, 1,
                 std::to_string(bad) + " of " + std::to_string(result.rows) +
                     " rows are malformed or have stamps that do not rise, this one first",
                 "mend it or cut the file there");
}

}  // namespace

FileReport read_table(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                      ReadReport& report, const RowHandler& handle, RowsOf rows) {
  const TextFile text = read_text_file(file);
  if (text.ends_early) {
    report.notes.push_back(file.string() + ": the xz stream ends early; what came through is used");
  }
  CsvReader reader(file, text.text, columns);
  FileReport result;
  result.file = file;
  const std::vector<bool> outliers = outliers_of(reader, rows);
  std::size_t well_formed = 0;
  std::optional<TimestampNs> last_ns;
  for (auto row = reader.next(); row != CsvReader::Row::kEnd; row = reader.next()) {
    ++result.rows;
    std::optional<RowFault> fault;
    if (row == CsvReader::Row::kTorn) {
      fault = RowFault::kTorn;
    } else if (row == CsvReader::Row::kMalformed) {
      fault = RowFault::kMalformed;
      if (result.first_malformed.empty()) result.first_malformed = reader.problem();
    } else {
      fault =
          outliers[well_formed++] ? RowFault::kOutlier : judge_stamp(reader.stamp_ns(), last_ns);
      if (!fault) fault = handle(reader);
    }
    if (fault) {
      result.refuse(*fault, reader.line());
    } else {
      last_ns = reader.stamp_ns();
      ++result.accepted;
    }
  }
  require_most(result);
  return result;
}

}  // namespace vpdr::dataset
