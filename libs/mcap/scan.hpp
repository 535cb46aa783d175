#pragma once
// Goes through a file record by record, for files without a usable summary.
#include "mcap/reader.hpp"

namespace vpdr::mcap {

/// Fills `contents` from the records after the header, the first at `offset`. Stops at the end of
/// the data section, or where the file stops making sense: `incomplete` then says where and why.
void scan(const Source& source, const ReaderOptions& options, std::uint64_t offset,
          Contents& contents);

}  // namespace vpdr::mcap
