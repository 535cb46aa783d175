#pragma once
#include <cstdint>
#include <map>

#include "dds/participant.hpp"

namespace vpdr::dds::detail {

/// Counts what is missing in the sequence numbers of each writer. Not thread-safe. What a writer
/// sent before its first sample seen here is not missing: this reader came later.
class SequenceGaps {
 public:
  std::uint64_t gap_before(const Guid& writer, std::uint64_t sequence_number) {
    const auto [at, first] = last_.try_emplace(writer, sequence_number);
    if (first) return 0;
    const std::uint64_t last = at->second;
    if (sequence_number <= last) return 0;  // best effort: late, its gap was counted
    at->second = sequence_number;
    return sequence_number - last - 1;
  }

 private:
  std::map<Guid, std::uint64_t> last_;
};

}  // namespace vpdr::dds::detail
