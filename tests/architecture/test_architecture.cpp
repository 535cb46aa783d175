// What may include what (docs/architecture.md). Reads the sources, so a broken rule fails here with
// the file and the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = VPDR_SOURCE_DIR;

struct Include {
  std::string file;  ///< relative to the root
  int line = 0;
  std::string name;  ///< what is included
};

std::vector<fs::path> sources_under(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".hpp" || extension == ".cpp") files.push_back(entry.path());
  }
  return files;
}

std::vector<Include> includes_under(const fs::path& folder) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const fs::path& file : sources_under(folder)) {
    std::ifstream in(file);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      std::smatch match;
      if (std::regex_search(line, match, kInclude)) {
        includes.push_back({fs::relative(file, kRoot).string(), number, match[1]});
      }
    }
  }
  return includes;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&text](const std::string& prefix) { return text.starts_with(prefix); });
}

const std::vector<std::string> kServices{"imu_gateway", "pdr", "vision", "fusion", "recorder"};
const std::vector<std::string> kIdl{"builtin_interfaces.h", "std_msgs.h", "geometry_msgs.h",
                                    "sensor_msgs.h",        "nav_msgs.h", "diagnostic_msgs.h",
                                    "vpdr_msgs.h"};
const std::vector<std::string> kMiddleware{"fastdds", "fastrtps", "fastcdr"};

void expect_none(const fs::path& folder, const std::vector<std::string>& forbidden,
                 const std::string& rule) {
  for (const Include& include : includes_under(folder)) {
    EXPECT_FALSE(starts_with_any(include.name, forbidden))
        << include.file << ":" << include.line << ": includes " << include.name << "; " << rule;
  }
}

TEST(Architecture, TheScanSeesTheProject) {
  EXPECT_GT(includes_under(kRoot / "libs").size(), 100U);
  EXPECT_GT(includes_under(kRoot / "services").size(), 50U);
}

TEST(Architecture, LibsCoreNeedsStdAndEigenOnly) {
  for (const Include& include : includes_under(kRoot / "libs/core")) {
    const bool is_std =
        include.name.find('/') == std::string::npos && include.name.find('.') == std::string::npos;
    EXPECT_TRUE(is_std || starts_with_any(include.name, {"core/", "Eigen/"}))
        << include.file << ":" << include.line << ": includes " << include.name;
  }
}

TEST(Architecture, LibsCalibrationNeedsStdEigenAndLibsCoreOnly) {
  for (const Include& include : includes_under(kRoot / "libs/calibration")) {
    const bool is_std =
        include.name.find('/') == std::string::npos && include.name.find('.') == std::string::npos;
    EXPECT_TRUE(is_std || starts_with_any(include.name, {"core/", "calibration/", "Eigen/"}))
        << include.file << ":" << include.line << ": includes " << include.name;
  }
}

TEST(Architecture, CoresNeedTheirOwnAndLibsCoreOnly) {
  for (const std::string& service : kServices) {
    for (const Include& include : includes_under(kRoot / "services" / service / "core")) {
      const bool is_std = include.name.find('/') == std::string::npos &&
                          include.name.find('.') == std::string::npos;
      std::vector<std::string> allowed{"core/", "Eigen/", service + "/core/"};
      if (service == "imu_gateway") allowed.emplace_back("calibration/");  // as pure as a core
      if (service == "vision") allowed.insert(allowed.end(), {"opencv2/", "ceres/"});
      EXPECT_TRUE(is_std || starts_with_any(include.name, allowed))
          << include.file << ":" << include.line << ": a core includes " << include.name;
    }
  }
}

TEST(Architecture, CoresReadNoClockAndStartNoThread) {
  for (const std::string& service : kServices) {
    expect_none(kRoot / "services" / service / "core",
                {"thread", "mutex", "condition_variable", "future", "chrono", "ctime", "iostream",
                 "fstream", "filesystem"},
                "an algorithm is a pure function of its samples");
  }
}

TEST(Architecture, ServicesMeetOnTopicsOnly) {
  for (const std::string& service : kServices) {
    std::vector<std::string> others;
    for (const std::string& other : kServices) {
      if (other != service) others.push_back(other + "/");
    }
    expect_none(kRoot / "services" / service, others, "services never include each other");
  }
}

TEST(Architecture, LibsDoNotKnowTheServices) {
  std::vector<std::string> services;
  for (const std::string& service : kServices) services.push_back(service + "/");
  expect_none(kRoot / "libs", services, "a lib serves every service and includes none");
}

TEST(Architecture, FastDdsLivesInLibsDdsOnly) {
  const std::string rule = "Fast DDS lives in libs/dds only";
  for (const char* lib : {"core", "config", "app", "dataset", "mcap", "simulation", "evaluation"}) {
    expect_none(kRoot / "libs" / lib, kMiddleware, rule);
  }
  expect_none(kRoot / "services", kMiddleware, rule);
  expect_none(kRoot / "tools", kMiddleware, rule);
}

TEST(Architecture, MessagesAppearInDdsAndAppsOnly) {
  const std::string rule = "generated types appear in libs/dds, libs/app, app/ and tools/ only";
  for (const char* lib : {"core", "config", "dataset", "mcap", "simulation", "evaluation"}) {
    expect_none(kRoot / "libs" / lib, kIdl, rule);
  }
  for (const std::string& service : kServices) {
    expect_none(kRoot / "services" / service / "core", kIdl, rule);
    expect_none(kRoot / "services" / service / "source", kIdl, rule);
  }
}

TEST(Architecture, YamlLivesInConfigAndReadersOnly) {
  for (const char* folder : {"libs/core", "libs/dds", "libs/app", "libs/mcap", "libs/simulation",
                             "libs/evaluation", "services", "tools"}) {
    expect_none(kRoot / folder, {"yaml-cpp/"}, "YAML is read by libs/config and libs/dataset only");
  }
}

TEST(Architecture, FilesStayReadable) {
  for (const char* top : {"libs", "services", "tools", "tests", "bench"}) {
    for (const fs::path& file : sources_under(kRoot / top)) {
      std::ifstream in(file);
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      EXPECT_LE(lines, 400) << fs::relative(file, kRoot) << " is perhaps two rooms";
    }
  }
}

TEST(Architecture, MainsAreShort) {
  for (const std::string& service : kServices) {
    std::ifstream in(kRoot / "services" / service / "main.cpp");
    ASSERT_TRUE(in) << service << " has no main.cpp";
    EXPECT_LE(std::count(std::istreambuf_iterator<char>(in), {}, '\n'), 30) << service;
  }
}

}  // namespace
