#pragma once
// Writes the folder of a run while it goes on (run_directory.hpp lists the files).
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/estimates.hpp"
#include "evaluation/output_file.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// One run's folder. Rows of each file must rise in time: a row that is not newer than the one
/// before is left out and counted, so that what is written can be read again. Every failed write
/// throws FileFault. Not thread-safe.
///
///   RunWriter writer(dir, {.vision_heading = !recording.images.empty()});
///   writer.add_attitude(attitude); writer.add_pdr(odometry); writer.add_step(step); ...
///   writer.finish({.duration_s = ..., .speed_factor = ...});
class RunWriter {
 public:
  struct Options {
    bool vision_heading = false;  ///< the recording has images: write vision_heading.csv
  };

  /// Creates the folder and its files.
  RunWriter(std::filesystem::path folder, const Options& options);

  void add_attitude(const AttitudeEstimate& attitude);
  void add_step(const StepEvent& step);
  void add_pdr(const PoseEstimate& pose);
  void add_fused(const PoseEstimate& pose);
  /// Makes vision.tum with the first row.
  void add_vision(const PoseEstimate& pose);
  /// Headings that found no corridor are left out.
  void add_vision_heading(const CorridorHeading& heading);

  /// Rows left out because they were not newer than the one before.
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

  /// Writes summary.json and closes every file. Steps and distance are those written unless
  /// `summary` has its own (not zero).
  void finish(Summary summary);

 private:
  /// A file and the stamp of its last row.
  struct Table {
    explicit Table(std::filesystem::path path) : file(std::move(path)) {}
    OutputFile file;
    std::optional<TimestampNs> last_ns;
  };
  bool is_newer(Table& table, TimestampNs stamp_ns);
  void add_tum_row(Table& table, const PoseEstimate& pose);

  std::filesystem::path folder_;
  Table fused_;
  Table covariance_;
  Table pdr_;
  std::unique_ptr<Table> vision_;
  Table attitude_;
  Table steps_;
  std::unique_ptr<Table> vision_heading_;
  LineBuffer line_;
  Summary written_;
  std::uint64_t left_out_ = 0;
};

/// Writes DIR/summary.json; throws FileFault.
void write_summary(const std::filesystem::path& folder, const Summary& summary);

}  // namespace vpdr::evaluation
