#pragma once
// What a reader refused, and where: bad rows are not fatal, but never silent.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vpdr::dataset {

/// Why a row was refused.
enum class RowFault : std::uint8_t {
  kTorn,         ///< the last line, cut short
  kMalformed,    ///< wrong number of cells, or a cell that is no number
  kNonFinite,    ///< nan or inf where a number is needed
  kDuplicate,    ///< the stamp of the row before
  kBackward,     ///< a stamp older than that of the row before
  kMissingFile,  ///< names an image that is not there
  kOutlier,      ///< a stamp far from those of all rows around it
};
inline constexpr std::size_t kRowFaultCount = 7;

/// Name for people: "torn", "malformed", "non-finite", "duplicate", "backward", "missing file",
/// "stamp outlier".
const char* name_of(RowFault fault);

/// How often, and the first line numbers (counted from 1).
struct FaultLines {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> first_lines;
};

/// One file.
struct FileReport {
  std::filesystem::path file;
  std::uint64_t rows = 0;  ///< data rows seen
  std::uint64_t accepted = 0;
  std::array<FaultLines, kRowFaultCount> faults;
  std::string first_malformed;  ///< place and reason of the first malformed row, empty if none

  void refuse(RowFault fault, std::uint64_t line);
  [[nodiscard]] std::uint64_t refused() const;
  [[nodiscard]] std::uint64_t refused(RowFault fault) const {
    return faults[static_cast<std::size_t>(fault)].count;
  }
};

/// All files of a recording.
struct ReadReport {
  std::vector<FileReport> files;
  std::vector<std::string> notes;  ///< what the reader assumed or did without
  [[nodiscard]] std::uint64_t refused() const;
  /// One line for each file with refused rows and one for each note.
  [[nodiscard]] std::vector<std::string> lines() const;
};

}  // namespace vpdr::dataset
