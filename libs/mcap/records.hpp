#pragma once
// The records of an MCAP file (format version 0), as written between the two magic byte strings:
// opcode (1 byte), content length (8 bytes), content; all integers little-endian.
// Times are nanoseconds since the epoch of the clock named beside each field; this library keeps
// them as int64, so a stamp beyond the year 2262 counts as damage.
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace vpdr::mcap {

/// First and last bytes of every complete file; '0' is the major version of the format.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Opcode and content length in front of every record.
inline constexpr std::size_t kRecordPrefixBytes = 9;

using StringMap = std::map<std::string, std::string>;

struct Header {
  std::string profile;  ///< "ros2" for CDR messages with ros2msg schemas
  std::string library;  ///< who wrote the file
};

struct Footer {
  std::uint64_t summary_start = 0;         ///< 0: the file has no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: no summary offsets
  std::uint32_t summary_crc = 0;           ///< 0: not given
};

/// What the bytes of a message mean.
struct Schema {
  std::uint16_t id = 0;  ///< 0 is not a schema: a channel with schema 0 has none
  std::string name;      ///< "sensor_msgs/msg/Imu"
  std::string encoding;  ///< "ros2msg"
  std::string text;
};

/// A stream of messages on one topic.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  StringMap metadata;            ///< "offered_qos_profiles" as rosbag2 writes it, ...
};

/// One message. `data` belongs to whoever made the view.
struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  TimestampNs log_time_ns = 0;      ///< recorder's host clock, at reception
  TimestampNs publish_time_ns = 0;  ///< publisher's host clock, at publication
  std::span<const std::byte> data;
};

/// A chunk: schemas, channels and messages, compressed together.
struct ChunkView {
  TimestampNs start_ns = 0;  ///< least log time inside, 0 when it holds no message
  TimestampNs end_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not given
  std::string_view compression;        ///< "" or "zstd" (or one this library does not read)
  std::span<const std::byte> records;
};

struct MessageIndexEntry {
  TimestampNs log_time_ns = 0;
  std::uint64_t offset = 0;  ///< of the message record in the uncompressed chunk
};

struct ChunkIndex {
  TimestampNs start_ns = 0;
  TimestampNs end_ns = 0;
  std::uint64_t chunk_offset = 0;  ///< of the chunk record in the file
  std::uint64_t chunk_length = 0;  ///< of the whole record, prefix included
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;  ///< by channel; may be empty
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  TimestampNs start_ns = 0;  ///< least log time in the file, 0 when it holds no message
  TimestampNs end_ns = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

/// Named pairs of text: the walker, the configuration, the recorder's counters.
struct Metadata {
  std::string name;
  StringMap entries;
};

struct MetadataIndex {
  std::uint64_t offset = 0;  ///< of the metadata record in the file
  std::uint64_t length = 0;  ///< of the whole record, prefix included
  std::string name;
};

/// Where the records of one opcode lie in the summary.
struct SummaryOffset {
  Opcode group = Opcode::kSchema;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
};

struct DataEnd {
  std::uint32_t data_crc = 0;  ///< of every byte before this record; 0: not given
};

}  // namespace vpdr::mcap
