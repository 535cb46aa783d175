#pragma once
// Reads an MCAP file: by its summary when that is whole, else by going through every record, so
// that a file whose writer was cut off gives all it holds up to the cut. A chunk that fails its
// CRC is left out and told; what comes after it is read.
//
// Nothing in a file can make the reader leave its bounds: every length is checked against what is
// there, chunks above ReaderOptions' limits are refused, and memory stays within those limits plus
// an entry for each chunk.
//
// Example:
//   auto reader = Reader::open("walk.mcap");
//   if (!reader) return reader.error();
//   MessageStream stream(reader.value(), {.topics = {"rt/ann/imu/data"}});
//   while (const std::optional<Message> message = stream.next()) use(*message);
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "mcap/records.hpp"
#include "mcap/segment.hpp"
#include "mcap/source.hpp"

namespace vpdr::mcap {

/// What the file holds, without its messages.
struct Contents {
  Header header;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  Statistics statistics;
  std::vector<Segment> segments;  ///< in file order
  std::vector<Metadata> metadata;
  std::string compression;  ///< of the chunks: "none", "zstd", or both; "" without chunks
  std::uint64_t file_bytes = 0;
  std::uint64_t readable_bytes = 0;  ///< up to here the file's records are whole
  bool from_summary = false;
  /// Empty: the file was closed by its writer. Else what is missing.
  std::string incomplete;
  std::vector<Damage> damage;  ///< places before readable_bytes that had to be left out
};

class Reader {
 public:
  /// Fails when the file cannot be opened or is no MCAP file; the message names it.
  [[nodiscard]] static Result<Reader> open(const std::filesystem::path& path,
                                           const ReaderOptions& options = {});
  [[nodiscard]] static Result<Reader> open(std::unique_ptr<Source> source,
                                           const ReaderOptions& options = {});

  [[nodiscard]] const Contents& contents() const { return contents_; }
  [[nodiscard]] const Source& source() const { return *source_; }
  [[nodiscard]] const ReaderOptions& options() const { return options_; }
  [[nodiscard]] const Channel* find_channel(std::uint16_t id) const;
  /// Null for a channel without one.
  [[nodiscard]] const Schema* schema_of(const Channel& channel) const;

 private:
  Reader(std::unique_ptr<Source> source, const ReaderOptions& options);

  std::unique_ptr<Source> source_;
  ReaderOptions options_;
  Contents contents_;
};

enum class Order : std::uint8_t {
  kLogTime,  ///< by log time; equal times in file order
  kFile,     ///< as written, least memory
};

struct Selection {
  std::set<std::string> topics;                                    ///< empty: all
  TimestampNs from_ns = 0;                                         ///< log time, inclusive
  TimestampNs until_ns = std::numeric_limits<TimestampNs>::max();  ///< inclusive
  Order order = Order::kLogTime;
};

/// The messages of a file one by one. The reader must outlive it. Not thread-safe; several streams
/// of one reader are independent of each other.
class MessageStream {
 public:
  explicit MessageStream(const Reader& reader, Selection selection = {});
  MessageStream(MessageStream&&) noexcept;
  MessageStream& operator=(MessageStream&&) noexcept;
  ~MessageStream();

  /// The next message; its data lives until the next call. Nothing at the end.
  [[nodiscard]] std::optional<Message> next();
  /// Chunks that had to be left out so far.
  [[nodiscard]] const std::vector<Damage>& damage() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vpdr::mcap
