#pragma once
// Records to bytes: each function appends one whole record, prefix included. Views are copied.
#include <span>

#include "mcap/bytes.hpp"
#include "mcap/records.hpp"

namespace vpdr::mcap {

void append(Buffer& out, const Header& record);
void append(Buffer& out, const Footer& record);
void append(Buffer& out, const Schema& record);
void append(Buffer& out, const Channel& record);
void append(Buffer& out, const Message& record);
void append(Buffer& out, const ChunkView& record);
void append(Buffer& out, const ChunkIndex& record);
void append(Buffer& out, const Statistics& record);
void append(Buffer& out, const Metadata& record);
void append(Buffer& out, const MetadataIndex& record);
void append(Buffer& out, const SummaryOffset& record);
void append(Buffer& out, const DataEnd& record);
void append_message_index(Buffer& out, std::uint16_t channel_id,
                          std::span<const MessageIndexEntry> entries);

/// Bytes of a message record with `data_size` bytes of data, prefix included.
constexpr std::size_t message_record_size(std::size_t data_size) {
  return kRecordPrefixBytes + 2 + 4 + 8 + 8 + data_size;
}

}  // namespace vpdr::mcap
