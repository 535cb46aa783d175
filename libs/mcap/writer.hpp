#pragma once
// Writes an MCAP file as a stream: messages gather in a chunk, a full or old chunk is compressed
// and appended in one write together with its message indexes, and close() adds the summary.
//
// What a crash costs: at most the chunk in memory, which spans no more than `chunk_duration_ns` of
// log time (call flush() from a timer so that a silent topic does not hold it back). What a full
// disk costs: the chunk that did not fit; every whole chunk before it stays readable, the file is
// finished with a summary where that fits, and every call from then on gives the same error.
//
// Memory: one chunk, its compressed copy, and an index entry for each chunk (some 100 bytes, plus
// 16 for each channel in it: about 1 MB for an hour of ten topics).
//
// Not thread-safe. Example:
//   auto writer = Writer::create("walk.mcap", {});
//   if (!writer) return writer.error();
//   const auto schema = writer.value().add_schema("std_msgs/msg/String", "ros2msg", text);
//   const auto channel = writer.value().add_channel({0, schema.value(), "chatter", "cdr", {}});
//   writer.value().write({channel.value(), 1, log_time_ns, publish_time_ns, cdr_bytes});
//   writer.value().close();
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "mcap/records.hpp"

namespace vpdr::mcap {

enum class Compression : std::uint8_t { kNone, kZstd };

/// When the writer waits for the disk, against loss of power; a crash of the process alone loses
/// nothing that was appended, whatever this says.
enum class SyncPolicy : std::uint8_t {
  kNever,      ///< the operating system decides
  kOnClose,    ///< once, at the end
  kEachChunk,  ///< at every chunk and at the end
};

struct WriterOptions {
  std::string profile = "ros2";  ///< of the header
  std::string library = "vpdr";  ///< of the header
  Compression compression = Compression::kZstd;
  int zstd_level = 1;                     ///< 1 fastest ... 19 smallest
  std::uint64_t chunk_bytes = 1U << 20U;  ///< a chunk of this many uncompressed bytes is full
  TimestampNs chunk_duration_ns = kNsPerSecond;  ///< a chunk that spans this much is full
  SyncPolicy sync = SyncPolicy::kEachChunk;
};

class Writer {
 public:
  /// Creates `path` with its header; refuses a path that exists.
  [[nodiscard]] static Result<Writer> create(const std::filesystem::path& path,
                                             const WriterOptions& options = {});
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) noexcept;
  /// Closes a writer that was not closed; an error on the way is not told.
  ~Writer();

  /// Id of the schema; one that is already there with the same three fields is given again.
  [[nodiscard]] Result<std::uint16_t> add_schema(std::string_view name, std::string_view encoding,
                                                 std::string_view text);
  /// Id of the new channel; `channel.id` is ignored. Refuses an unknown schema.
  [[nodiscard]] Result<std::uint16_t> add_channel(Channel channel);
  /// Refuses an unknown channel and a negative time.
  [[nodiscard]] Status write(const Message& message);
  [[nodiscard]] Status write(const Metadata& metadata);
  /// Appends the chunk in memory to the file, if it holds anything.
  [[nodiscard]] Status flush();
  /// Flushes, writes the summary, syncs and closes. Later calls give the first call's result.
  [[nodiscard]] Status close();

  /// Of what is in the file: messages count once their chunk is appended.
  [[nodiscard]] const Statistics& statistics() const;
  [[nodiscard]] std::uint64_t messages_in_file(std::uint16_t channel_id) const;
  [[nodiscard]] std::uint64_t bytes_in_file() const;

 private:
  class Implementation;
  explicit Writer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vpdr::mcap
