#pragma once
// Whole text files, plain or xz.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/errors.hpp"

namespace vpdr::dataset {

/// A file's text. `ends_early`: the xz stream stops before its end; the text is what came through.
struct TextFile {
  std::filesystem::path file;
  std::string text;
  bool ends_early = false;
};

/// `path` itself or `path`.xz, whichever is there; nullopt if neither.
std::optional<std::filesystem::path> find_plain_or_xz(const std::filesystem::path& path);

/// Reads a plain file, or an xz file where the name ends in ".xz"; a byte order mark of UTF-8 is
/// left out. Throws FileFault.
TextFile read_text_file(const std::filesystem::path& file);

/// "file:line:column: what; remedy"; line and column counted from 1, left out where 0.
FileFault fault_at(const std::filesystem::path& file, std::uint64_t line, std::uint64_t column,
                   std::string_view what, std::string_view remedy);

}  // namespace vpdr::dataset
