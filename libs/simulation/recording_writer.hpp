#pragma once
// Writes a simulated walk as a recording folder (docs/recordings.md): samples, truth, steps, and
// the camera's pictures.
#include <filesystem>
#include <functional>

#include "simulation/corridor_renderer.hpp"
#include "simulation/walk.hpp"

namespace vpdr::simulation {

struct RecordingOptions {
  bool images = true;  ///< false: no cam0/; much quicker
  int jpeg_quality = 90;
  double truth_rate_hz = 100.0;  ///< rows of groundtruth.csv
  RenderOptions render;
};

/// Called with the share that is done, 0 to 1, often enough for a progress bar.
using Progress = std::function<void(double share)>;

/// Writes the recording into `folder`, which is made. A folder that holds an earlier simulated walk
/// is written anew; any other that is not empty is left alone. Throws FileFault for that, and where
/// a file cannot be written.
void write_recording(const SimulatedWalk& walk, const std::filesystem::path& folder,
                     const RecordingOptions& options = {}, const Progress& progress = {});

}  // namespace vpdr::simulation
