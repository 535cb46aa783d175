#pragma once
// A file that only grows, every write checked. A write that fails part-way is undone, so that the
// file always ends where the last successful append ended.
#include <cstdint>
#include <filesystem>
#include <span>

#include "core/result.hpp"

namespace vpdr::mcap {

/// Owns the file descriptor. Movable, not thread-safe.
class OutputFile {
 public:
  /// Creates `path`; refuses one that exists.
  [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// All of `bytes`, or none of them and the reason.
  [[nodiscard]] Status append(std::span<const std::byte> bytes);
  /// Shortens the file to `size`, a size it had before.
  [[nodiscard]] Status shorten(std::uint64_t size);
  /// Returns when the bytes are on the disk.
  [[nodiscard]] Status sync();
  [[nodiscard]] Status close();

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  OutputFile(std::filesystem::path path, int descriptor);
  [[nodiscard]] Error failure(const char* action, int code) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace vpdr::mcap
