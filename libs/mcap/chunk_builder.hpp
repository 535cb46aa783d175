#pragma once
// The chunk in memory: records, message indexes and time span; and its bytes for the file.
#include <cstdint>
#include <map>
#include <vector>

#include "core/result.hpp"
#include "mcap/bytes.hpp"
#include "mcap/records.hpp"

struct ZSTD_CCtx_s;

namespace vpdr::mcap {

/// Reuses its buffers from chunk to chunk. Not thread-safe.
class ChunkBuilder {
 public:
  ChunkBuilder() = default;
  ChunkBuilder(const ChunkBuilder&) = delete;
  ChunkBuilder& operator=(const ChunkBuilder&) = delete;
  ~ChunkBuilder();

  void add(const Schema& schema);
  void add(const Channel& channel);
  void add(const Message& message);

  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] std::uint64_t size() const { return records_.size(); }
  [[nodiscard]] std::uint64_t message_count() const { return message_count_; }
  /// Span of log times with `log_time_ns` taken in, nanoseconds.
  [[nodiscard]] TimestampNs span_with(TimestampNs log_time_ns) const;
  [[nodiscard]] const std::map<std::uint16_t, std::vector<MessageIndexEntry>>& indexes() const {
    return indexes_;
  }

  /// Appends the chunk record and its message index records to `out`, whose first byte will be at
  /// `file_offset` of the file. Level 0: not compressed.
  [[nodiscard]] Result<ChunkIndex> encode(int zstd_level, std::uint64_t file_offset, Buffer& out);
  /// Empties the chunk; keeps its buffers.
  void clear();

 private:
  [[nodiscard]] Status compress(int zstd_level);

  Buffer records_;
  Buffer compressed_;
  std::map<std::uint16_t, std::vector<MessageIndexEntry>> indexes_;
  std::uint64_t message_count_ = 0;
  TimestampNs start_ns_ = 0;
  TimestampNs end_ns_ = 0;
  ZSTD_CCtx_s* context_ = nullptr;
};

}  // namespace vpdr::mcap
