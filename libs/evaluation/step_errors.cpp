#include "evaluation/step_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vpdr::evaluation {
namespace {

struct Candidate {
  StepPair pair;
  TimestampNs distance_ns = 0;
};

std::vector<Candidate> candidates(const std::vector<TimestampNs>& truth_ns,
                                  const std::vector<TimestampNs>& counted_ns) {
  std::vector<Candidate> result;
  std::size_t first = 0;
  for (std::size_t i = 0; i < truth_ns.size(); ++i) {
    while (first < counted_ns.size() && counted_ns[first] < truth_ns[i] - kStepMatchNs) ++first;
    for (std::size_t j = first; j < counted_ns.size(); ++j) {
      if (counted_ns[j] > truth_ns[i] + kStepMatchNs) break;
      result.push_back({{i, j}, std::abs(counted_ns[j] - truth_ns[i])});
    }
  }
  return result;
}

template <class Step>
std::vector<TimestampNs> stamps_of(const std::vector<Step>& steps) {
  std::vector<TimestampNs> stamps;
  stamps.reserve(steps.size());
  for (const Step& step : steps) stamps.push_back(step.stamp_ns);
  return stamps;
}

bool in_bouts(const std::optional<std::vector<dataset::Interval>>& bouts, TimestampNs t) {
  if (!bouts) return true;
  return std::any_of(bouts->begin(), bouts->end(), [t](const dataset::Interval& bout) {
    return bout.begin_ns - kStepMatchNs <= t && t <= bout.end_ns + kStepMatchNs;
  });
}

void compare_lengths(const std::vector<StepPair>& pairs,
                     const std::vector<dataset::TrueStep>& truth,
                     const std::vector<RunStep>& counted, StepTiming& timing) {
  double n = 0.0;
  double sum_true = 0.0;
  double sum_error = 0.0;
  double sum_square = 0.0;
  for (const StepPair& pair : pairs) {
    const double length = truth[pair.truth].length_m;
    if (!std::isfinite(length)) continue;
    const double error = counted[pair.counted].length_m - length;
    n += 1.0;
    sum_true += length;
    sum_error += error;
    sum_square += error * error;
  }
  if (n == 0.0 || sum_true <= 0.0) return;
  timing.length_bias_percent = 100.0 * sum_error / sum_true;
  timing.length_rmse_m = std::sqrt(sum_square / n);
}

StepTiming compare_instants(const std::vector<dataset::TrueStep>& truth,
                            const std::vector<RunStep>& counted) {
  const auto pairs = match_steps(stamps_of(truth), stamps_of(counted));
  StepTiming timing;
  timing.matched = pairs.size();
  const auto n = static_cast<double>(pairs.size());
  timing.recall_percent = 100.0 * n / static_cast<double>(truth.size());
  if (pairs.empty()) return timing;
  timing.precision_percent = 100.0 * n / static_cast<double>(counted.size());
  double sum = 0.0;
  double sum_square = 0.0;
  for (const StepPair& pair : pairs) {
    const double offset = to_seconds(counted[pair.counted].stamp_ns - truth[pair.truth].stamp_ns);
    sum += offset;
    sum_square += offset * offset;
  }
  timing.mean_offset_s = sum / n;
  timing.sigma_s =
      std::sqrt(std::max(0.0, sum_square / n - timing.mean_offset_s * timing.mean_offset_s));
  compare_lengths(pairs, truth, counted, timing);
  return timing;
}

}  // namespace

std::vector<StepPair> match_steps(const std::vector<TimestampNs>& truth_ns,
                                  const std::vector<TimestampNs>& counted_ns) {
  std::vector<Candidate> all = candidates(truth_ns, counted_ns);
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_ns < b.distance_ns;
  });
  std::vector<bool> truth_used(truth_ns.size(), false);
  std::vector<bool> counted_used(counted_ns.size(), false);
  std::vector<StepPair> pairs;
  for (const Candidate& candidate : all) {
    const auto [i, j] = candidate.pair;
    if (truth_used[i] || counted_used[j]) continue;
    truth_used[i] = counted_used[j] = true;
    pairs.push_back(candidate.pair);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const StepPair& a, const StepPair& b) { return a.truth < b.truth; });
  return pairs;
}

std::optional<StepErrors> step_errors(const RunDirectory& run,
                                      const dataset::Recording& recording) {
  const dataset::Truth& truth = recording.truth;
  const double known = recording.about.true_steps.value_or(static_cast<double>(truth.steps.size()));
  if (!(known > 0.0)) return std::nullopt;
  std::vector<RunStep> counted;
  std::copy_if(run.steps.begin(), run.steps.end(), std::back_inserter(counted),
               [&](const RunStep& step) { return in_bouts(truth.walking_bouts, step.stamp_ns); });
  StepErrors errors;
  errors.truth = static_cast<std::uint64_t>(std::llround(known));
  errors.counted = counted.size();
  errors.error_percent = 100.0 * std::abs(static_cast<double>(counted.size()) - known) / known;
  if (!truth.steps.empty()) errors.timing = compare_instants(truth.steps, counted);
  return errors;
}

}  // namespace vpdr::evaluation
