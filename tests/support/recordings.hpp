#pragma once
// Where the recordings for tests are: $VPDR_DATA, else <source>/../shared/data. Tests that need
// them begin with VPDR_REQUIRE_RECORDINGS(root).
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace vpdr::testing {

inline std::optional<std::filesystem::path> recordings_root() {
  const char* const named = std::getenv("VPDR_DATA");
  const std::filesystem::path root =
      named != nullptr ? named : std::filesystem::path(VPDR_SOURCE_DIR) / "../shared/data";
  std::error_code ignored;
  if (!std::filesystem::is_directory(root / "walks", ignored)) return std::nullopt;
  return root;
}

}  // namespace vpdr::testing

#define VPDR_REQUIRE_RECORDINGS(root)                           \
  const auto root##_found = ::vpdr::testing::recordings_root(); \
  if (!root##_found) GTEST_SKIP() << "skipped: no data";        \
  const std::filesystem::path root = *root##_found
