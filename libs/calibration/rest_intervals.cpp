#include "calibration/rest_intervals.hpp"

#include <cmath>
#include <optional>
#include <span>

#include "calibration/window.hpp"

namespace vpdr::calibration {
namespace {

/// What is watched of one sensor.
struct Watch {
  const std::vector<TimedVector>* stream = nullptr;
  double sigma = 0.0;
  double step = 0.0;
};

/// Whether the sensor was still in the window, and still as in the window before.
bool is_still(const Watch& watch, TimestampNs begin_ns, TimestampNs end_ns,
              std::optional<Eigen::Vector3d>& mean) {
  if (watch.stream->empty()) return true;
  const WindowMoments moments = moments_of(window_of(*watch.stream, begin_ns, end_ns));
  if (moments.count < 3 || moments.sigma > watch.sigma) {
    mean.reset();
    return false;
  }
  const bool steady = !mean || (moments.mean - *mean).norm() <= watch.step;
  mean = moments.mean;
  return steady;
}

Rest rest_of(const SensorStreams& streams, TimestampNs begin_ns, TimestampNs end_ns) {
  Rest rest;
  rest.begin_ns = begin_ns;
  rest.end_ns = end_ns;
  const WindowMoments force = moments_of(window_of(streams.force_mps2, begin_ns, end_ns));
  rest.force_mps2 = force.mean;
  rest.force_sigma_mps2 = force.sigma;
  rest.samples = force.count;
  rest.rate_radps = moments_of(window_of(streams.rate_radps, begin_ns, end_ns)).mean;
  return rest;
}

}  // namespace

std::vector<Rest> find_rests(const SensorStreams& streams, const RestConfig& config) {
  const Watch force{&streams.force_mps2, config.force_sigma_mps2, config.force_step_mps2};
  const Watch rate{&streams.rate_radps, config.rate_sigma_radps, config.rate_step_radps};
  const auto& main = streams.force_mps2.empty() ? streams.rate_radps : streams.force_mps2;
  std::vector<Rest> rests;
  if (main.empty()) return rests;
  const TimestampNs window_ns = to_ns(config.window_s);
  std::optional<TimestampNs> since;
  std::optional<Eigen::Vector3d> force_mean;
  std::optional<Eigen::Vector3d> rate_mean;
  const auto close = [&](TimestampNs at) {
    // The outer windows may hold the beginning of a motion: they are left out.
    if (since && at - *since >= to_ns(config.min_duration_s) + 2 * window_ns) {
      rests.push_back(rest_of(streams, *since + window_ns, at - window_ns));
    }
    since.reset();
  };
  TimestampNs at = main.front().stamp_ns;
  for (; at + window_ns <= main.back().stamp_ns; at += window_ns) {
    const bool force_still = is_still(force, at, at + window_ns, force_mean);
    const bool rate_still = is_still(rate, at, at + window_ns, rate_mean);
    if (!force_still || !rate_still) {
      close(at);
    } else if (!since) {
      since = at;
    }
  }
  close(at);
  return rests;
}

std::vector<std::size_t> number_poses(const std::vector<Rest>& rests, double angle_rad) {
  std::vector<Eigen::Vector3d> poses;
  std::vector<std::size_t> numbers;
  for (const Rest& rest : rests) {
    const Eigen::Vector3d direction = rest.force_mps2.normalized();
    const auto same = std::find_if(poses.begin(), poses.end(), [&](const Eigen::Vector3d& pose) {
      return pose.dot(direction) > std::cos(angle_rad);
    });
    numbers.push_back(static_cast<std::size_t>(same - poses.begin()));
    if (same == poses.end()) poses.push_back(direction);
  }
  return numbers;
}

}  // namespace vpdr::calibration
