#include "dataset/read_report.hpp"

namespace vpdr::dataset {
namespace {

constexpr std::size_t kLinesKept = 5;

std::string describe(const FileReport& file) {
  std::string text = file.file.string() + ": refused " + std::to_string(file.refused()) + " of " +
                     std::to_string(file.rows) + " rows:";
  const char* separator = " ";
  for (std::size_t i = 0; i < kRowFaultCount; ++i) {
    const FaultLines& fault = file.faults[i];
    if (fault.count == 0) continue;
    text += separator + std::to_string(fault.count) + " " + name_of(static_cast<RowFault>(i)) +
            (fault.count == 1 ? " (line" : " (lines");
    for (const std::uint64_t line : fault.first_lines) text += " " + std::to_string(line);
    text += fault.count > fault.first_lines.size() ? " ...)" : ")";
    separator = ", ";
  }
  if (!file.first_malformed.empty()) text += "; first: " + file.first_malformed;
  return text;
}

}  // namespace

const char* name_of(RowFault fault) {
  switch (fault) {
    case RowFault::kTorn:
      return "torn";
    case RowFault::kMalformed:
      return "malformed";
    case RowFault::kNonFinite:
      return "non-finite";
    case RowFault::kDuplicate:
      return "duplicate";
    case RowFault::kBackward:
      return "backward";
    case RowFault::kMissingFile:
      return "missing file";
    case RowFault::kOutlier:
      return "stamp outlier";
  }
  return "unknown";
}

void FileReport::refuse(RowFault fault, std::uint64_t line) {
  FaultLines& lines = faults[static_cast<std::size_t>(fault)];
  ++lines.count;
  if (lines.first_lines.size() < kLinesKept) lines.first_lines.push_back(line);
}

std::uint64_t FileReport::refused() const {
  std::uint64_t sum = 0;
  for (const FaultLines& fault : faults) sum += fault.count;
  return sum;
}

std::uint64_t ReadReport::refused() const {
  std::uint64_t sum = 0;
  for (const FileReport& file : files) sum += file.refused();
  return sum;
}

std::vector<std::string> ReadReport::lines() const {
  std::vector<std::string> lines;
  for (const FileReport& file : files) {
    if (file.refused() > 0) lines.push_back(describe(file));
  }
  lines.insert(lines.end(), notes.begin(), notes.end());
  return lines;
}

}  // namespace vpdr::dataset
