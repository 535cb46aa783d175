#include "calibration/allan_deviation.hpp"

#include <cmath>
#include <span>
#include <string>

#include "calibration/median.hpp"
#include "calibration/window.hpp"

namespace vpdr::calibration {
namespace {

constexpr double kShortestS = 30.0;
/// sqrt(2 ln 2 / pi): what flicker noise of size 1 leaves in the flat part of the curve.
constexpr double kFlatPart = 0.664;
/// Longest averaging time as a share of the record: beyond, the estimate scatters by a third.
constexpr double kLongestShare = 1.0 / 8.0;

/// The running integral at `count` + 1 instants, `tau0_s` apart.
std::vector<Eigen::Vector3d> integral_of(std::span<const TimedVector> samples, double tau0_s,
                                         std::size_t count) {
  std::vector<Eigen::Vector3d> out{Eigen::Vector3d::Zero()};
  out.reserve(count + 1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const TimestampNs begin = samples.front().stamp_ns;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double from_s = to_seconds(samples[i - 1].stamp_ns - begin);
    const double to_s = to_seconds(samples[i].stamp_ns - begin);
    // Each sample holds from the one before it to itself, as a sensor that averages does.
    while (out.size() <= count && static_cast<double>(out.size()) * tau0_s <= to_s) {
      out.emplace_back(sum +
                       (static_cast<double>(out.size()) * tau0_s - from_s) * samples[i].value);
    }
    sum += (to_s - from_s) * samples[i].value;
  }
  return out;
}

Eigen::Vector3d deviation_at(const std::vector<Eigen::Vector3d>& integral, std::size_t m,
                             double tau_s) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t count = integral.size() - 2 * m;
  for (std::size_t k = 0; k < count; ++k) {
    sum += (integral[k + 2 * m] - 2.0 * integral[k + m] + integral[k]).cwiseAbs2();
  }
  return (sum / (2.0 * tau_s * tau_s * static_cast<double>(count))).cwiseSqrt();
}

/// Where white noise rules: the median of deviation * sqrt(tau) up to a second.
Eigen::Vector3d noise_density_of(const std::vector<AllanPoint>& curve) {
  Eigen::Vector3d out;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const AllanPoint& point : curve) {
      if (point.tau_s <= 1.0) values.push_back(point.deviation[axis] * std::sqrt(point.tau_s));
    }
    out[axis] = median(values);
  }
  return out;
}

}  // namespace

Result<AllanDeviation> allan_deviation(const std::vector<TimedVector>& stream, TimestampNs begin_ns,
                                       TimestampNs end_ns) {
  const auto samples = window_of(stream, begin_ns, end_ns);
  AllanDeviation out;
  if (samples.size() > 1) {
    out.duration_s = to_seconds(samples.back().stamp_ns - samples.front().stamp_ns);
  }
  if (out.duration_s < kShortestS) {
    return Error{"a rest of " + std::to_string(out.duration_s) +
                 " s is too short for the Allan deviation; let the board lie for a minute, for its "
                 "bias instability for ten"};
  }
  const auto count = samples.size() - 1;
  const double tau0_s = out.duration_s / static_cast<double>(count);
  const std::vector<Eigen::Vector3d> integral = integral_of(samples, tau0_s, count);
  out.bias_instability.setConstant(std::numeric_limits<double>::infinity());
  for (std::size_t m = 1; static_cast<double>(m) * tau0_s <= kLongestShare * out.duration_s;
       m *= 2) {
    const double tau_s = static_cast<double>(m) * tau0_s;
    out.curve.push_back({tau_s, deviation_at(integral, m, tau_s)});
    out.bias_instability = out.bias_instability.cwiseMin(out.curve.back().deviation / kFlatPart);
  }
  out.noise_density = noise_density_of(out.curve);
  return out;
}

}  // namespace vpdr::calibration
