#pragma once
// Accelerations of made walkers, and what a step detector makes of them.
#include <cmath>
#include <functional>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/steps/step_detector.hpp"

namespace vpdr::pdr::made {

struct Given {
  DetectedStep step;
  TimestampNs at_ns;  ///< stamp of the sample that brought it
};

using Signal = std::function<double(double)>;

/// How a board is held against the way it was held at first, and how fast it turns.
struct Handling {
  std::function<Eigen::Quaterniond(double)> turned = [](double) {
    return Eigen::Quaterniond::Identity();
  };
  double rate_radps = 0.0;
};

/// All words about steps of a board whose specific force has the norm g + signal(t).
inline std::vector<Given> words(StepDetector& detector, const Signal& signal, double duration_s,
                                double rate_hz = 100.0, TimestampNs start_ns = 0,
                                const Handling& handling = {}) {
  std::vector<Given> out;
  const Eigen::Vector3d direction = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  for (int i = 0; i <= static_cast<int>(duration_s * rate_hz); ++i) {
    const double t = i / rate_hz;
    const TimestampNs stamp = start_ns + to_ns(t);
    detector.add(stamp, (kGravityMps2 + signal(t)) * (handling.turned(t) * direction),
                 {0.0, 0.0, handling.rate_radps});
    while (const auto step = detector.take()) out.push_back({*step, stamp});
  }
  return out;
}

/// Of these words the confirmed steps.
inline std::vector<Given> confirmed(const std::vector<Given>& all) {
  std::vector<Given> out;
  for (const Given& given : all) {
    if (given.step.status == StepStatus::kConfirmed) out.push_back(given);
  }
  return out;
}

/// Peaks at 1 s, 1 s + 1 / f, ... until `until_s`; quiet before and after.
inline Signal walk(double steps_per_s, double until_s, double amplitude = 3.0) {
  return [=](double t) {
    const double phase = (t - 1.0) * steps_per_s;
    if (phase < -0.5 || t > until_s) return 0.0;
    return amplitude * std::cos(2.0 * kPi * phase);
  };
}

/// One bump of 4 m/s^2 and 0.1 s at each of these instants.
inline Signal bumps(std::vector<double> instants_s) {
  return [instants_s = std::move(instants_s)](double t) {
    double sum = 0.0;
    for (const double k : instants_s) {
      if (std::abs(t - k) < 0.5) sum += 4.0 * std::exp(-0.5 * std::pow((t - k) / 0.1, 2.0));
    }
    return sum;
  };
}

}  // namespace vpdr::pdr::made
