#include "calibration/accelerometer.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/median.hpp"
#include "calibration/sphere_coverage.hpp"
#include "calibration/window.hpp"

namespace vpdr::calibration {
namespace {

/// One sample for each rest. Rests of one pose share its weight: their common error is the pose's.
std::vector<LengthSample> samples_of(const std::vector<Rest>& rests,
                                     const std::vector<std::size_t>& pose_of_rest, double sigma) {
  std::vector<LengthSample> samples;
  for (std::size_t i = 0; i < rests.size(); ++i) {
    const auto same = std::count(pose_of_rest.begin(), pose_of_rest.end(), pose_of_rest[i]);
    samples.push_back({rests[i].force_mps2, sigma * std::sqrt(static_cast<double>(same))});
  }
  return samples;
}

bool is_within(const std::vector<Rest>& rests, TimestampNs stamp_ns) {
  return std::any_of(rests.begin(), rests.end(), [stamp_ns](const Rest& rest) {
    return rest.begin_ns <= stamp_ns && stamp_ns < rest.end_ns;
  });
}

/// Readings now and then outside of the rests, where the board turned slowly.
void add_motion(const SensorStreams& streams, const std::vector<Rest>& rests,
                const AccelerometerConfig& config, std::vector<LengthSample>& samples) {
  const TimestampNs interval_ns = to_ns(config.motion_interval_s);
  const std::size_t first = samples.size();
  TimestampNs next_ns = 0;
  for (const TimedVector& force : streams.force_mps2) {
    if (force.stamp_ns < next_ns || is_within(rests, force.stamp_ns)) continue;
    const auto rate = moments_of(window_of(streams.rate_radps, force.stamp_ns - interval_ns / 2,
                                           force.stamp_ns + interval_ns / 2));
    if (rate.mean.norm() > config.motion_rate_radps) continue;
    samples.push_back({force.value, 0.0});
    next_ns = force.stamp_ns + interval_ns;
  }
  std::vector<double> errors;
  for (std::size_t i = first; i < samples.size(); ++i) {
    errors.push_back(std::abs(samples[i].value.norm() - config.gravity_mps2));
  }
  const double sigma = std::max(config.motion_sigma_mps2, kDeviationPerMedian * median(errors));
  for (std::size_t i = first; i < samples.size(); ++i) samples[i].sigma = sigma;
}

double length_rms(const std::vector<Rest>& rests, const LinearCorrection& correction,
                  double gravity) {
  double sum = 0.0;
  for (const Rest& rest : rests) {
    sum += std::pow(correction.apply(rest.force_mps2).norm() / gravity - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(rests.size()));
}

}  // namespace

Result<AccelerometerCalibration> calibrate_accelerometer(const SensorStreams& streams,
                                                         const std::vector<Rest>& rests,
                                                         const AccelerometerConfig& config) {
  const std::vector<std::size_t> pose_of_rest = number_poses(rests);
  AccelerometerCalibration out;
  out.rests = rests.size();
  for (const std::size_t pose : pose_of_rest) out.poses = std::max(out.poses, pose + 1);
  if (out.poses < config.min_poses) {
    return Error{"poses in which the board lay still: " + std::to_string(out.poses) +
                 "; lay it down for two seconds on each of its six sides"};
  }
  std::vector<LengthSample> samples = samples_of(rests, pose_of_rest, config.pose_sigma_mps2);
  add_motion(streams, rests, config, samples);

  EllipsoidConfig fit_config;
  fit_config.scale_sigma = config.scale_sigma;
  fit_config.skew_sigma = config.skew_sigma;
  fit_config.bias_sigma = config.bias_sigma_mps2 / config.gravity_mps2;
  const EllipsoidFit fit =
      fit_ellipsoid(samples, {Eigen::Vector3d::Zero(), config.gravity_mps2}, fit_config);
  if (fit.worst_sigma > config.max_length_sigma) {
    return Error{std::to_string(out.poses) +
                 " poses do not tell all of the accelerometer; lay the "
                 "board down for two seconds so that it reads gravity along " +
                 direction_name(fit.worst_direction)};
  }
  out.correction = fit.correction;
  out.worst_sigma = fit.worst_sigma;
  out.rms_before = length_rms(rests, {}, config.gravity_mps2);
  out.rms = length_rms(rests, out.correction, config.gravity_mps2);
  return out;
}

}  // namespace vpdr::calibration
