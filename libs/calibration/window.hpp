#pragma once
// Pieces of a stream and their first two moments.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

/// The samples with begin <= stamp < end.
inline std::span<const TimedVector> window_of(std::span<const TimedVector> stream,
                                              TimestampNs begin_ns, TimestampNs end_ns) {
  const auto before = [](const TimedVector& sample, TimestampNs t) { return sample.stamp_ns < t; };
  const auto begin = std::lower_bound(stream.begin(), stream.end(), begin_ns, before);
  const auto end = std::lower_bound(begin, stream.end(), end_ns, before);
  return {begin, end};
}

/// Mean and deviation about it, all axes together.
struct WindowMoments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sigma = 0.0;
  std::size_t count = 0;
};

inline WindowMoments moments_of(std::span<const TimedVector> window) {
  WindowMoments out;
  out.count = window.size();
  if (window.empty()) return out;
  for (const TimedVector& sample : window) out.mean += sample.value;
  out.mean /= static_cast<double>(window.size());
  for (const TimedVector& sample : window) out.sigma += (sample.value - out.mean).squaredNorm();
  out.sigma = std::sqrt(out.sigma / static_cast<double>(window.size()));
  return out;
}

}  // namespace vpdr::calibration
