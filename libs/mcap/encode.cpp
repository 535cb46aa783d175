#include "mcap/encode.hpp"

namespace vpdr::mcap {
namespace {

/// Writes the prefix, lets `write_content` append, and fills in the length.
template <class WriteContent>
void append_record(Buffer& out, Opcode opcode, WriteContent write_content) {
  ByteWriter writer(out);
  writer.integer(static_cast<std::uint8_t>(opcode));
  const std::size_t length_at = out.size();
  writer.integer(std::uint64_t{0});
  write_content(writer);
  const std::uint64_t length = out.size() - length_at - sizeof(std::uint64_t);
  for (std::size_t i = 0; i < sizeof(length); ++i) {
    out[length_at + i] = static_cast<std::byte>(length >> (8 * i));
  }
}

void write_counts(ByteWriter& w, const std::map<std::uint16_t, std::uint64_t>& counts) {
  w.integer(static_cast<std::uint32_t>(counts.size() * 10));
  for (const auto& [channel, count] : counts) {
    w.integer(channel);
    w.integer(count);
  }
}

}  // namespace

void append(Buffer& out, const Header& record) {
  append_record(out, Opcode::kHeader, [&](ByteWriter& w) {
    w.string(record.profile);
    w.string(record.library);
  });
}

void append(Buffer& out, const Footer& record) {
  append_record(out, Opcode::kFooter, [&](ByteWriter& w) {
    w.integer(record.summary_start);
    w.integer(record.summary_offset_start);
    w.integer(record.summary_crc);
  });
}

void append(Buffer& out, const Schema& record) {
  append_record(out, Opcode::kSchema, [&](ByteWriter& w) {
    w.integer(record.id);
    w.string(record.name);
    w.string(record.encoding);
    w.string(record.text);
  });
}

void append(Buffer& out, const Channel& record) {
  append_record(out, Opcode::kChannel, [&](ByteWriter& w) {
    w.integer(record.id);
    w.integer(record.schema_id);
    w.string(record.topic);
    w.string(record.message_encoding);
    w.map(record.metadata);
  });
}

void append(Buffer& out, const Message& record) {
  append_record(out, Opcode::kMessage, [&](ByteWriter& w) {
    w.integer(record.channel_id);
    w.integer(record.sequence);
    w.time(record.log_time_ns);
    w.time(record.publish_time_ns);
    w.bytes(record.data);
  });
}

void append(Buffer& out, const ChunkView& record) {
  append_record(out, Opcode::kChunk, [&](ByteWriter& w) {
    w.time(record.start_ns);
    w.time(record.end_ns);
    w.integer(record.uncompressed_size);
    w.integer(record.uncompressed_crc);
    w.string(record.compression);
    w.integer(static_cast<std::uint64_t>(record.records.size()));
    w.bytes(record.records);
  });
}

void append_message_index(Buffer& out, std::uint16_t channel_id,
                          std::span<const MessageIndexEntry> entries) {
  append_record(out, Opcode::kMessageIndex, [&](ByteWriter& w) {
    w.integer(channel_id);
    w.integer(static_cast<std::uint32_t>(entries.size() * 16));
    for (const MessageIndexEntry& entry : entries) {
      w.time(entry.log_time_ns);
      w.integer(entry.offset);
    }
  });
}

void append(Buffer& out, const ChunkIndex& record) {
  append_record(out, Opcode::kChunkIndex, [&](ByteWriter& w) {
    w.time(record.start_ns);
    w.time(record.end_ns);
    w.integer(record.chunk_offset);
    w.integer(record.chunk_length);
    write_counts(w, record.message_index_offsets);
    w.integer(record.message_index_length);
    w.string(record.compression);
    w.integer(record.compressed_size);
    w.integer(record.uncompressed_size);
  });
}

void append(Buffer& out, const Statistics& record) {
  append_record(out, Opcode::kStatistics, [&](ByteWriter& w) {
    w.integer(record.message_count);
    w.integer(record.schema_count);
    w.integer(record.channel_count);
    w.integer(record.attachment_count);
    w.integer(record.metadata_count);
    w.integer(record.chunk_count);
    w.time(record.start_ns);
    w.time(record.end_ns);
    write_counts(w, record.channel_message_counts);
  });
}

void append(Buffer& out, const Metadata& record) {
  append_record(out, Opcode::kMetadata, [&](ByteWriter& w) {
    w.string(record.name);
    w.map(record.entries);
  });
}

void append(Buffer& out, const MetadataIndex& record) {
  append_record(out, Opcode::kMetadataIndex, [&](ByteWriter& w) {
    w.integer(record.offset);
    w.integer(record.length);
    w.string(record.name);
  });
}

void append(Buffer& out, const SummaryOffset& record) {
  append_record(out, Opcode::kSummaryOffset, [&](ByteWriter& w) {
    w.integer(static_cast<std::uint8_t>(record.group));
    w.integer(record.start);
    w.integer(record.length);
  });
}

void append(Buffer& out, const DataEnd& record) {
  append_record(out, Opcode::kDataEnd, [&](ByteWriter& w) { w.integer(record.data_crc); });
}

}  // namespace vpdr::mcap
