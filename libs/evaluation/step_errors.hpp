#pragma once
// How many steps were counted, when, and how long they were, against the truth.
#include <optional>
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// Largest distance in time between a true step and the step counted for it.
inline constexpr TimestampNs kStepMatchNs = kNsPerSecond / 4;

/// A true step and the counted one that stands for it: indices into the two lists.
struct StepPair {
  std::size_t truth = 0;
  std::size_t counted = 0;
};

/// Pairs within kStepMatchNs, each step used once, the closest pairs first; in order of the truth.
/// Both lists must rise.
std::vector<StepPair> match_steps(const std::vector<TimestampNs>& truth_ns,
                                  const std::vector<TimestampNs>& counted_ns);

/// Instants of steps, where the truth has them.
struct StepTiming {
  std::uint64_t matched = 0;
  double recall_percent = 0.0;     ///< of the true steps
  double precision_percent = 0.0;  ///< of the counted steps
  double mean_offset_s = 0.0;      ///< counted minus true
  double sigma_s = 0.0;            ///< of the offset
  /// Over matched steps whose true length is known; nullopt without.
  std::optional<double> length_bias_percent;
  std::optional<double> length_rmse_m;
};

struct StepErrors {
  std::uint64_t truth = 0;
  std::uint64_t counted = 0;
  double error_percent = 0.0;  ///< |counted - truth| of truth
  std::optional<StepTiming> timing;
};

/// The true number is about.yaml's where it says one, else that of the steps listed. Where the
/// truth covers walking bouts only, steps counted within them (widened by kStepMatchNs) are
/// compared. nullopt where the recording knows no steps.
std::optional<StepErrors> step_errors(const RunDirectory& run, const dataset::Recording& recording);

}  // namespace vpdr::evaluation
