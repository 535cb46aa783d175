#pragma once
// A piece of the data section that is read as a whole: a chunk, or messages that stand outside
// chunks.
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "mcap/bytes.hpp"
#include "mcap/parse.hpp"
#include "mcap/source.hpp"

namespace vpdr::mcap {

struct ReaderOptions {
  /// A chunk or record that is larger is refused as damage.
  std::uint64_t max_chunk_bytes = std::uint64_t{256} << 20U;
  /// Chunks that overlap in time are held at once; beyond this, chunks are refused.
  std::uint64_t max_loaded_bytes = std::uint64_t{1} << 30U;
};

struct Segment {
  std::uint64_t offset = 0;  ///< in the file
  std::uint64_t length = 0;  ///< in the file
  bool is_chunk = true;
  TimestampNs start_ns = 0;  ///< log times inside
  TimestampNs end_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::set<std::uint16_t> channels;  ///< with messages inside; empty: not known
};

/// A place in the file that could not be read, and why.
struct Damage {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string reason;
};

/// The records of a segment, uncompressed. `records` views into the two buffers, or outlives them
/// by nothing: move the whole struct only.
struct LoadedSegment {
  Buffer file_bytes;
  Buffer plain_bytes;
  Content records;
};

/// Reads and uncompresses a segment into `loaded`, whose buffers are reused.
[[nodiscard]] Status load(const Source& source, const Segment& segment,
                          const ReaderOptions& options, LoadedSegment& loaded);

}  // namespace vpdr::mcap
