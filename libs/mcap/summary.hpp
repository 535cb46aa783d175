#pragma once
// The summary section: what a reader needs to find anything without reading the data, and its way
// to and from bytes.
#include <cstdint>
#include <map>
#include <vector>

#include "core/result.hpp"
#include "mcap/bytes.hpp"
#include "mcap/parse.hpp"
#include "mcap/records.hpp"

namespace vpdr::mcap {

struct Summary {
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  Statistics statistics;
  std::vector<ChunkIndex> chunk_indexes;
  std::vector<MetadataIndex> metadata_indexes;
};

/// Appends the summary, the summary offsets and the footer with its CRC to `out`; the first byte
/// appended will be at `file_offset` of the file. The schema and channel counts of the statistics
/// are those of `summary`.
void append_summary_section(const Summary& summary, std::uint64_t file_offset, Buffer& out);

/// Reads the records between the footer's summary start and the footer. Records that a summary
/// does not have are skipped.
[[nodiscard]] Result<Summary> parse_summary_section(Content records);

}  // namespace vpdr::mcap
