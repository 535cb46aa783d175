#pragma once
// From the recording of five services to the folder of a run, so that what was recorded over DDS is
// evaluated and reported as what `vpdr run` computed.
#include <cstdint>
#include <filesystem>
#include <string>

#include "evaluation/run_info.hpp"

namespace vpdr::run_export {

struct ExportOptions {
  std::string title = "five services over DDS";
  std::filesystem::path recording;  ///< the walk that was played; empty: none, or not known
};

/// What was found on the way; the folder holds the rest.
struct ExportReport {
  evaluation::RunInfo info;      ///< as written to run.json
  std::uint64_t messages = 0;    ///< read from the file
  std::uint64_t unreadable = 0;  ///< messages whose bytes do not fit their type
  std::uint64_t left_out = 0;    ///< rows that were not newer than the one before
  std::string incomplete;        ///< empty: the file is whole; else what is missing
  std::uint64_t damaged_chunks = 0;
};

/// Reads `file` and writes the files of a run to `folder` (evaluation/run_directory.hpp):
/// trajectory.tum from fusion/odometry (fusion/pose where there is none), pdr.tum from
/// pdr/odometry, attitude.csv from imu/data, steps.csv from pdr/step, vision_heading.csv from
/// vision/heading where there is such a topic, summary.json, and run.json.
///
/// run.json gets the latency from inertial sample to fused pose: for each fused pose of stamp t,
/// the time at which the recorder received it less the time at which the sample of stamp t was sent
/// (the first pose of a stamp counts; both clocks must be of one host), and as lost the samples
/// from the first such pose on that have none. Also the recorder's counts of each topic and the
/// last state of each service.
///
/// Reads a torn file as far as it goes. Throws FileFault: no recording, no pose in it, topics of
/// several walkers or of other types, folder not writable.
ExportReport export_run(const std::filesystem::path& file, const std::filesystem::path& folder,
                        const ExportOptions& options = {});

}  // namespace vpdr::run_export
