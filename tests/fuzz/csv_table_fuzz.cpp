// libFuzzer target: any text as a table of a recording. A wrong header is a FileFault; rows are
// good, torn or malformed, and there are no more of them than lines; any stamps may be looked at
// for outliers.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/errors.hpp"
#include "dataset/csv_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using vpdr::dataset::CsvColumn;
  using vpdr::dataset::CsvReader;
  const std::array<CsvColumn, 3> columns{
      CsvColumn{.names = {"w_x", "w_RS_S_x"}, .units = {"rad s^-1", "rad/s"}},
      CsvColumn{.names = {"name"}, .units = {}, .kind = CsvColumn::Kind::kText, .required = false},
      CsvColumn{
          .names = {"more"}, .units = {}, .kind = CsvColumn::Kind::kIgnored, .required = false}};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    CsvReader reader("table.csv", text, columns);
    auto rows = std::count(text.begin(), text.end(), '\n') + 1;
    std::vector<vpdr::TimestampNs> stamps;
    for (auto row = reader.next(); row != CsvReader::Row::kEnd; row = reader.next()) {
      if (--rows < 0) std::abort();
      if (row == CsvReader::Row::kGood) stamps.push_back(reader.stamp_ns());
    }
    for (const auto kind : {vpdr::dataset::RowsOf::kSamples, vpdr::dataset::RowsOf::kEvents}) {
      if (vpdr::dataset::stamp_outliers(stamps, kind).size() != stamps.size()) std::abort();
    }
  } catch (const vpdr::FileFault&) {
  }
  return 0;
}
