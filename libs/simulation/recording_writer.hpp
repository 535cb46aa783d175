#pragma once
// Writes a simulated walk, or a recorded one with rendered pictures, as a recording folder
// (docs/recordings.md): samples, truth, steps, the camera's pictures and their depth.
#include <filesystem>
#include <functional>

#include "simulation/path_walk.hpp"
#include "simulation/render/film.hpp"
#include "simulation/walk_camera.hpp"

namespace vpdr::simulation {

struct RecordingOptions {
  bool images = true;  ///< false: no cam0/; much quicker
  bool depth = false;  ///< true: depth0/data/STAMP.png, 16-bit millimetres along the optical axis
  int jpeg_quality = 90;
  double truth_rate_hz = 100.0;  ///< rows of a simulated walk's groundtruth.csv
  FilmOptions film;
};

/// Called with the share that is done, 0 to 1, often enough for a progress bar.
using Progress = std::function<void(double share)>;

/// Writes the recording into `folder`, which is made. A folder that holds an earlier simulated walk
/// is written anew; any other that is not empty is left alone. Throws FileFault for that, and where
/// a file cannot be written.
void write_recording(const SimulatedWalk& walk, const std::filesystem::path& folder,
                     const RecordingOptions& options = {}, const Progress& progress = {});
void write_recording(const PathWalk& walk, const std::filesystem::path& folder,
                     const RecordingOptions& options = {}, const Progress& progress = {});

}  // namespace vpdr::simulation
