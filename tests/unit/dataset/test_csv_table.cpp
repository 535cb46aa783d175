#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "dataset/csv_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::array<CsvColumn, 3> kColumns = {{
    {{"a", "alpha"}, {"m", "metre"}, CsvColumn::Kind::kNumber, true},
    {{"b"}, {"m"}, CsvColumn::Kind::kNumber, false},
    {{"word"}, {}, CsvColumn::Kind::kText, false},
}};

std::string fault_of(std::string_view text) {
  try {
    CsvReader reader("t.csv", text, kColumns);
  } catch (const FileFault& fault) {
    EXPECT_EQ(fault.code(), ExitCode::kFile);
    return fault.what();
  }
  return "no fault";
}

TEST(CsvReader, FindsColumnsByNameInAnyOrder) {
  CsvReader reader("t.csv", "#timestamp [ns],word,b [m],alpha [metre]\n7,hi,2.5,-1e3\n", kColumns);
  ASSERT_EQ(reader.next(), CsvReader::Row::kGood);
  EXPECT_EQ(reader.stamp_ns(), 7);
  EXPECT_DOUBLE_EQ(reader.number(0), -1000.0);
  EXPECT_DOUBLE_EQ(reader.number(1), 2.5);
  EXPECT_EQ(reader.text(2), "hi");
  EXPECT_EQ(reader.next(), CsvReader::Row::kEnd);
}

TEST(CsvReader, AbsentOptionalColumnsReadAsNan) {
  CsvReader reader("t.csv", "#timestamp [ns], a\r\n7, +4 \r\n", kColumns);
  ASSERT_EQ(reader.next(), CsvReader::Row::kGood);
  EXPECT_DOUBLE_EQ(reader.number(0), 4.0);
  EXPECT_TRUE(std::isnan(reader.number(1)));
}

TEST(CsvReader, NamesPlaceAndRemedyOfAnUnknownColumn) {
  EXPECT_EQ(fault_of("#timestamp [ns],a [m],wind [m/s]\n1,2,3\n"),
            "t.csv:1:23: unknown column 'wind [m/s]'; remove or rename it; this table has "
            "timestamp a b word");
}

TEST(CsvReader, RefusesHeadersThatCannotBeTrusted) {
  EXPECT_THAT(fault_of(""), HasSubstr("t.csv:1:1: the file is empty"));
  EXPECT_THAT(fault_of("1,2\n"), HasSubstr("t.csv:1:1: no header line"));
  EXPECT_THAT(fault_of("#time,a\n"), HasSubstr("first column is 'time'"));
  EXPECT_THAT(fault_of("#timestamp [s],a\n"), HasSubstr("must be 'timestamp [ns]'"));
  EXPECT_THAT(fault_of("#timestamp [ns],b [m]\n"), HasSubstr("column 'a' is missing"));
  EXPECT_THAT(fault_of("#timestamp [ns],a,alpha\n"),
              HasSubstr("t.csv:1:19: column 'alpha' comes twice"));
  EXPECT_THAT(fault_of("#timestamp [ns],a [cm]\n"), HasSubstr("has unit 'cm'; convert it to [m]"));
}

TEST(CsvReader, TellsATornLastLineFromAMalformedOne) {
  CsvReader reader("t.csv", "#timestamp [ns],a,b\n1,2,3\n2,x,3\n3,4\n4,5", kColumns);
  EXPECT_EQ(reader.next(), CsvReader::Row::kGood);
  EXPECT_EQ(reader.next(), CsvReader::Row::kMalformed);
  EXPECT_EQ(reader.problem(), "t.csv:3:3: 'x' is no number");
  EXPECT_EQ(reader.next(), CsvReader::Row::kMalformed);
  EXPECT_EQ(reader.problem(), "t.csv:4:1: 2 cells, the header has 3");
  EXPECT_EQ(reader.next(), CsvReader::Row::kTorn);
  EXPECT_EQ(reader.next(), CsvReader::Row::kEnd);
}

TEST(CsvReader, AcceptsALastLineWithoutNewline) {
  CsvReader reader("t.csv", "#timestamp [ns],a\n1,2", kColumns);
  EXPECT_EQ(reader.next(), CsvReader::Row::kGood);
  EXPECT_EQ(reader.next(), CsvReader::Row::kEnd);
}

TEST(ReadTable, CountsAndListsWhatItRefuses) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("t.csv",
                                 "#timestamp [ns],a\n10,1\n10,2\n9,3\n\n# a comment\n11,nan\n12,z\n"
                                 "13,5\n14");
  std::vector<double> seen;
  ReadReport report;
  const FileReport result =
      read_table(file, kColumns, report, [&](const CsvReader& row) -> std::optional<RowFault> {
        if (std::isnan(row.number(0))) return RowFault::kNonFinite;
        seen.push_back(row.number(0));
        return std::nullopt;
      });
  EXPECT_THAT(seen, ElementsAre(1.0, 5.0));
  EXPECT_EQ(result.rows, 7U);
  EXPECT_EQ(result.accepted, 2U);
  EXPECT_EQ(result.refused(), 5U);
  const auto lines = [&](RowFault fault) {
    return result.faults[static_cast<std::size_t>(fault)].first_lines;
  };
  EXPECT_THAT(lines(RowFault::kDuplicate), ElementsAre(3));
  EXPECT_THAT(lines(RowFault::kBackward), ElementsAre(4));
  EXPECT_THAT(lines(RowFault::kNonFinite), ElementsAre(7));
  EXPECT_THAT(lines(RowFault::kMalformed), ElementsAre(8));
  EXPECT_THAT(lines(RowFault::kTorn), ElementsAre(10));
  report.files.push_back(result);
  EXPECT_THAT(report.lines().front(),
              HasSubstr("refused 5 of 7 rows: 1 torn (line 10), 1 malformed (line 8), "));
}

TEST(ReadTable, FaultsWhereNoRowCanBeRead) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("t.csv", "#timestamp [ns],a\nx,1\ny,2\n");
  ReadReport report;
  try {
    read_table(file, kColumns, report, [](const CsvReader&) { return std::nullopt; });
    FAIL() << "no fault";
  } catch (const FileFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("t.csv:2:1: 'x' is no stamp in whole nanoseconds; no row"));
  }
}

/// Stamps 0, 10 ms, ...; the row of that line has another one.
std::string table_with(std::size_t rows, std::size_t line, const std::string& stamp) {
  std::string text = "#timestamp [ns],a\n";
  for (std::size_t i = 0; i < rows; ++i) {
    text += (i + 2 == line ? stamp : std::to_string(i * 10'000'000)) + ",1\n";
  }
  return text;
}

FileReport read(const std::filesystem::path& file) {
  ReadReport report;
  return read_table(
      file, kColumns, report, [](const CsvReader&) { return std::nullopt; }, RowsOf::kSamples);
}

TEST(ReadTable, AWrongStampCostsItsRowAlone) {
  const testing::TemporaryFolder folder;
  for (const std::size_t line : {2U, 3U, 1000U, 8001U}) {
    const auto file = folder.write("t.csv", table_with(8000, line, "9223372036854775807"));
    const FileReport result = read(file);
    EXPECT_EQ(result.accepted, 7999U);
    EXPECT_THAT(result.faults[static_cast<std::size_t>(RowFault::kOutlier)].first_lines,
                ElementsAre(line));
  }
  const auto file = folder.write("t.csv", table_with(8000, 2, "-9223372036854775808"));
  EXPECT_EQ(read(file).accepted, 7999U);
}

TEST(ReadTable, MostRowsRefusedIsAFaultOfTheFile) {
  const testing::TemporaryFolder folder;
  std::string text = table_with(100, 0, "");
  text.insert(text.find('\n') + 1, "9000000000,1\n9010000000,1\n9020000000,1\n");
  try {
    read(folder.write("t.csv", text));
    FAIL() << "no fault";
  } catch (const FileFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("t.csv:5:1: 100 of 103 rows"));
  }
}

TEST(ReadTable, SecondsTakenForNanosecondsAreAFaultOfTheFile) {
  const testing::TemporaryFolder folder;
  std::string text = "#timestamp [ns],a\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(1574561833 + i / 50) + ",1\n";
  try {
    read(folder.write("t.csv", text));
    FAIL() << "no fault";
  } catch (const FileFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("t.csv:3:1: 98 of 100 rows repeat the stamp before"));
    EXPECT_THAT(fault.what(), HasSubstr("whole nanoseconds"));
  }
}

TEST(CsvReader, DamagedBytesAreRefusedRowsOrAFaultAndNothingElse) {
  std::string good = "#timestamp [ns],a [m],b [m],word\n";
  for (int i = 0; i < 30; ++i) good += std::to_string(i) + ",1.5,-2e-3,name\n";
  std::mt19937 random(17);
  std::size_t rows = 0;
  std::size_t faults = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = good.substr(0, 1 + random() % good.size());
    for (int edit = 0; edit < 3; ++edit) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    try {
      CsvReader reader("t.csv", text, kColumns);
      for (auto row = reader.next(); row != CsvReader::Row::kEnd; row = reader.next()) ++rows;
    } catch (const FileFault&) {
      ++faults;
    }
  }
  EXPECT_GT(rows, 10000U);
  EXPECT_GT(faults, 100U);
}

}  // namespace
}  // namespace vpdr::dataset
