#pragma once
// The command line that programs share which measure on sets of data:
//   bench_NAME [DATA] [--csv FILE] [--only SET ...]
// DATA (default $VPDR_DATA, then ../shared/data) is the folder of recordings, unpacked.
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace vpdr::bench {

/// One set of data and what is measured on it.
struct Set {
  std::string name;
  std::string folder;  ///< in DATA; empty: it needs none
  /// `csv`: where rows of a table go, or null.
  std::function<void(const std::filesystem::path& folder, std::ofstream* csv)> run;
};

/// Runs the sets in their order; those whose data are absent say so. The exit code.
int run_sets(int argc, char** argv, const std::vector<Set>& sets);

}  // namespace vpdr::bench
