#include "bench/sets.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>

namespace vpdr::bench {

int run_sets(int argc, char** argv, const std::vector<Set>& sets) {
  std::string data =
      std::getenv("VPDR_DATA") != nullptr ? std::getenv("VPDR_DATA") : "../shared/data";
  std::string csv_file;
  std::vector<std::string> only, names;
  for (const Set& set : sets) names.push_back(set.name);
  CLI::App app("Figures on recorded and rendered sets of data.");
  app.add_option("data", data, "folder of recordings, unpacked")->capture_default_str();
  app.add_option("--csv", csv_file, "write a row for each frame");
  app.add_option("--only", only, "of these sets only")->check(CLI::IsMember(names));
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!csv_file.empty()) csv.open(csv_file);
  cv::setNumThreads(1);
  for (const Set& set : sets) {
    if (!only.empty() && std::find(only.begin(), only.end(), set.name) == only.end()) continue;
    const std::filesystem::path folder = std::filesystem::path(data) / set.folder;
    if (!set.folder.empty() && !std::filesystem::exists(folder)) {
      std::printf("%s: skipped: no data in %s\n", set.name.c_str(), folder.c_str());
      continue;
    }
    set.run(folder, csv.is_open() ? &csv : nullptr);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace vpdr::bench
