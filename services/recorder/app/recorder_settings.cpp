#include "recorder/app/recorder_settings.hpp"

#include <array>
#include <chrono>
#include <ctime>

namespace vpdr::recorder {

void bind(config::Binder& binder, RecorderSettings& s) {
  using config::above;
  using config::at_least;
  using config::between;
  binder.text("file", s.file, "recording to write; empty: <walker>_<UTC time>.mcap");
  binder.flag("replace", s.replace, "remove a recording of that name first, do not refuse it");
  binder.integer("chunk_kib", s.chunk_kib, between(1, 65536), "KiB",
                 "size at which a chunk is compressed and written");
  binder.number("chunk_s", s.chunk_s, between(0.01, 60), "s",
                "age at which a chunk is written; this much is lost in a crash at most");
  binder.integer("compression_level", s.compression_level, between(0, 19), "",
                 "of zstd: 1 fastest to 19 smallest; 0: not compressed");
  binder.choice<mcap::SyncPolicy>("sync", s.sync,
                                  {{"each_chunk", mcap::SyncPolicy::kEachChunk},
                                   {"on_close", mcap::SyncPolicy::kOnClose},
                                   {"never", mcap::SyncPolicy::kNever}},
                                  "when to wait for the disk, against loss of power");
  binder.integer("queue_mib", s.queue_mib, between(1, 4096), "MiB",
                 "samples that wait for the disk; when full, the senders are held up");
  binder.integer("low_space_mib", s.low_space_mib, at_least(0), "MiB",
                 "less free space than this is told as a fault");
}

std::filesystem::path recording_path(const RecorderSettings& settings, const std::string& walker) {
  if (!settings.file.empty()) return settings.file;
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "_%Y%m%dT%H%M%SZ.mcap", &utc);
  return walker + text.data();
}

mcap::WriterOptions writer_options(const RecorderSettings& settings) {
  mcap::WriterOptions options;
  options.library = "vpdr recorder";
  options.compression =
      settings.compression_level == 0 ? mcap::Compression::kNone : mcap::Compression::kZstd;
  options.zstd_level = static_cast<int>(settings.compression_level);
  options.chunk_bytes = std::uint64_t{settings.chunk_kib} * 1024;
  options.chunk_duration_ns = to_ns(settings.chunk_s);
  options.sync = settings.sync;
  return options;
}

}  // namespace vpdr::recorder
