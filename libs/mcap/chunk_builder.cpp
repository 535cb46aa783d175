#include "mcap/chunk_builder.hpp"

#include <zstd.h>

#include <algorithm>

#include "mcap/crc32.hpp"
#include "mcap/encode.hpp"

namespace vpdr::mcap {

ChunkBuilder::~ChunkBuilder() { ZSTD_freeCCtx(context_); }

void ChunkBuilder::add(const Schema& schema) { append(records_, schema); }

void ChunkBuilder::add(const Channel& channel) { append(records_, channel); }

void ChunkBuilder::add(const Message& message) {
  const TimestampNs time = message.log_time_ns;
  start_ns_ = message_count_ == 0 ? time : std::min(start_ns_, time);
  end_ns_ = message_count_ == 0 ? time : std::max(end_ns_, time);
  indexes_[message.channel_id].push_back({time, records_.size()});
  append(records_, message);
  ++message_count_;
}

TimestampNs ChunkBuilder::span_with(TimestampNs log_time_ns) const {
  if (message_count_ == 0) return 0;
  return std::max(end_ns_, log_time_ns) - std::min(start_ns_, log_time_ns);
}

Status ChunkBuilder::compress(int zstd_level) {
  if (context_ == nullptr) context_ = ZSTD_createCCtx();
  if (context_ == nullptr) return Error{"no memory for the zstd compressor"};
  compressed_.resize(ZSTD_compressBound(records_.size()));
  const std::size_t size = ZSTD_compressCCtx(context_, compressed_.data(), compressed_.size(),
                                             records_.data(), records_.size(), zstd_level);
  if (ZSTD_isError(size) != 0) {
    return Error{std::string("zstd cannot compress: ") + ZSTD_getErrorName(size)};
  }
  compressed_.resize(size);
  return Done{};
}

Result<ChunkIndex> ChunkBuilder::encode(int zstd_level, std::uint64_t file_offset, Buffer& out) {
  ChunkView chunk{start_ns_, end_ns_, records_.size(), crc32(records_), "", records_};
  if (zstd_level > 0) {
    if (const Status status = compress(zstd_level); !status) return status.error();
    chunk.compression = "zstd";
    chunk.records = compressed_;
  }
  const std::size_t first = out.size();
  append(out, chunk);
  ChunkIndex index;
  index.start_ns = start_ns_;
  index.end_ns = end_ns_;
  index.chunk_offset = file_offset;
  index.chunk_length = out.size() - first;
  index.compression = chunk.compression;
  index.compressed_size = chunk.records.size();
  index.uncompressed_size = chunk.uncompressed_size;
  const std::size_t indexes_first = out.size();
  for (auto& [channel, entries] : indexes_) {
    if (entries.empty()) continue;
    // The format asks for indexes in log time order; the messages themselves keep their order.
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; });
    index.message_index_offsets[channel] = file_offset + out.size() - first;
    append_message_index(out, channel, entries);
  }
  index.message_index_length = out.size() - indexes_first;
  return index;
}

void ChunkBuilder::clear() {
  records_.clear();
  for (auto& [channel, entries] : indexes_) entries.clear();
  message_count_ = 0;
  start_ns_ = end_ns_ = 0;
}

}  // namespace vpdr::mcap
