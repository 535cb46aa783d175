#pragma once
// The report of a run: DIR/report.html, one file that loads nothing from elsewhere, and
// DIR/trajectory.svg, the map alone. For engineers: headline figures, map, heading, steps, errors,
// latency, topics, services.
//
//   evaluation::write_report(dir);                       // finds the truth through DIR/run.json
//   evaluation::write_report(run, &recording);           // or with what is already at hand
#include <filesystem>
#include <string>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// Writes both files into run.folder. `recording` may be nullptr: then there is no truth to show.
/// Throws FileFault where a file cannot be written.
void write_report(const RunDirectory& run, const dataset::Recording* recording);

/// Reads DIR, and the recording that DIR/run.json names if it is still there, and writes both
/// files.
void write_report(const std::filesystem::path& folder);

/// The page as text.
std::string report_html(const RunDirectory& run, const dataset::Recording* recording);

}  // namespace vpdr::evaluation
