#pragma once
// Settings of the recorder.
#include <cstdint>
#include <filesystem>
#include <string>

#include "config/binder.hpp"
#include "mcap/writer.hpp"

namespace vpdr::recorder {

/// Bound as `recorder.*`.
struct RecorderSettings {
  std::string file;      ///< empty: "<walker>_<UTC time>.mcap" in the present folder
  bool replace = false;  ///< remove a file of that name first
  std::uint32_t chunk_kib = 1024;
  double chunk_s = 1.0;
  std::uint32_t compression_level = 1;  ///< of zstd; 0: none
  mcap::SyncPolicy sync = mcap::SyncPolicy::kEachChunk;
  std::uint32_t queue_mib = 64;
  std::uint32_t low_space_mib = 500;
};

void bind(config::Binder& binder, RecorderSettings& settings);

/// The file to record to; makes up its name where none is given.
std::filesystem::path recording_path(const RecorderSettings& settings, const std::string& walker);

mcap::WriterOptions writer_options(const RecorderSettings& settings);

}  // namespace vpdr::recorder
