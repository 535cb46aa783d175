#pragma once
// A text file under way to the disk.
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <string>

namespace vpdr::simulation {

/// Throws FileFault.
[[noreturn]] void cannot_write(const std::filesystem::path& file, const std::string& reason);

/// A text file whose failure to reach the disk is a fault: every function throws FileFault.
class TextOutput {
 public:
  explicit TextOutput(const std::filesystem::path& file);
  ~TextOutput();
  TextOutput(const TextOutput&) = delete;
  TextOutput& operator=(const TextOutput&) = delete;

  [[gnu::format(printf, 2, 3)]] void print(const char* format, ...);
  void finish();

 private:
  std::filesystem::path path_;
  std::FILE* file_;
};

}  // namespace vpdr::simulation
