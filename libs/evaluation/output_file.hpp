#pragma once
// A file that is written as the run goes, and says so when the disk is full.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace vpdr::evaluation {

/// Buffered text output. Every failure throws FileFault naming the file and the system's reason.
/// Not thread-safe.
class OutputFile {
 public:
  /// Creates or empties the file.
  explicit OutputFile(std::filesystem::path path);
  /// Closes without a word; call close() to know that all is on the disk.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// Hands all to the system and closes. Throws FileFault; nothing may be written afterwards.
  void close();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

/// Builds one line of numbers in a buffer that is reused.
class LineBuffer {
 public:
  LineBuffer& text(std::string_view text);
  LineBuffer& integer(std::int64_t value);
  LineBuffer& fixed(double value, int decimals);
  /// The line so far; empties the buffer at the next call of anything else.
  std::string_view take();

 private:
  void begin();
  std::string line_;
  bool taken_ = false;
};

}  // namespace vpdr::evaluation
