#include "calibration/turns.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/window.hpp"
#include "core/rotation.hpp"

namespace vpdr::calibration {
namespace {

constexpr int kRounds = 3;

/// The turn between two instants as a rotation vector; nullopt over a gap or a saturated reading.
std::optional<Eigen::Vector3d> turn_between(const std::vector<TimedVector>& rates,
                                            const Eigen::Vector3d& bias,
                                            const Eigen::Matrix3d& matrix, TimestampNs begin_ns,
                                            TimestampNs end_ns, const TurnConfig& config) {
  const auto window = window_of(rates, begin_ns, end_ns);
  if (window.size() < 2) return std::nullopt;
  const auto first = window.data() == rates.data() ? window.begin() : window.begin() - 1;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  TimestampNs at = begin_ns;
  for (auto next = first + 1; at < end_ns; ++next) {
    if (&*next >= rates.data() + rates.size()) return std::nullopt;
    const TimedVector& before = *(next - 1);
    if (to_seconds(next->stamp_ns - before.stamp_ns) > config.max_gap_s) return std::nullopt;
    if (next->value.cwiseAbs().maxCoeff() > config.saturation_radps) return std::nullopt;
    const TimestampNs until = std::min(next->stamp_ns, end_ns);
    if (until <= at) continue;
    const Eigen::Vector3d rate = matrix * (0.5 * (before.value + next->value) - bias);
    turn = turn * exp_rotation(rate * to_seconds(until - at));
    at = until;
  }
  return log_rotation(turn.normalized());
}

/// Mean direction about an instant.
std::optional<Eigen::Vector3d> direction_at(const std::vector<TimedVector>& directions,
                                            TimestampNs stamp_ns, TimestampNs half_ns) {
  const auto moments = moments_of(window_of(directions, stamp_ns - half_ns, stamp_ns + half_ns));
  if (moments.count == 0 || moments.mean.isZero()) return std::nullopt;
  return moments.mean.normalized();
}

}  // namespace

std::optional<RateAlignment::Solution> align_rates(const std::vector<TimedVector>& rates,
                                                   const Eigen::Vector3d& bias_radps,
                                                   const std::vector<TimedVector>& directions,
                                                   const TurnConfig& config) {
  if (rates.size() < 2 || directions.empty()) return std::nullopt;
  const TimestampNs length_ns = to_ns(config.window_s);
  const TimestampNs half_ns = to_ns(0.5 * config.smooth_s);
  // Turns about changing axes chain in the right order only once the axes are the right ones.
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  std::optional<RateAlignment::Solution> solution;
  for (int round = 0; round < kRounds; ++round) {
    RateAlignment alignment;
    const TimestampNs last = rates.back().stamp_ns;
    for (TimestampNs at = rates.front().stamp_ns; at + length_ns <= last; at += length_ns) {
      const auto turn = turn_between(rates, bias_radps, matrix, at, at + length_ns, config);
      if (!turn || turn->norm() < config.min_angle_rad || turn->norm() > config.max_angle_rad) {
        continue;
      }
      const auto before = direction_at(directions, at, half_ns);
      const auto after = direction_at(directions, at + length_ns, half_ns);
      if (!before || !after) continue;
      // About a fixed axis the mean direction turns by the chord: 2 tan(a / 2) is exact.
      const double angle = turn->norm();
      alignment.add(*turn * (2.0 * std::tan(0.5 * angle) / angle), *before, *after, config.sigma);
    }
    solution = alignment.solve();
    if (!solution) return std::nullopt;
    matrix = solution->direction_from_gyro * matrix;
    solution->direction_from_gyro = matrix;
  }
  return solution;
}

Eigen::Vector3d integrated_turn(const std::vector<TimedVector>& rates, TimestampNs begin_ns,
                                TimestampNs end_ns) {
  const auto window = window_of(rates, begin_ns, end_ns);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < window.size(); ++i) {
    sum += 0.5 * to_seconds(window[i].stamp_ns - window[i - 1].stamp_ns) *
           (window[i].value + window[i - 1].value);
  }
  return sum;
}

}  // namespace vpdr::calibration
