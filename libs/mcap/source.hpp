#pragma once
// Where a reader takes its bytes from. Reading does not change a source, so several streams may
// read one at a time or at once.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/result.hpp"

namespace vpdr::mcap {

class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Fills `out` from `offset` on; false when that is not all there or cannot be read.
  [[nodiscard]] virtual bool read(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

/// A regular file, whose size is taken when it is opened.
[[nodiscard]] Result<std::unique_ptr<Source>> open_file(const std::filesystem::path& path);

/// Bytes in memory, which must outlive the source.
[[nodiscard]] std::unique_ptr<Source> open_bytes(std::span<const std::byte> bytes);

}  // namespace vpdr::mcap
