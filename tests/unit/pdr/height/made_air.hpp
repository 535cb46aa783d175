#pragma once
// What a barometer reads on the way through a building: the truth of the tests of height.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/samples.hpp"

namespace vpdr::pdr::made {

/// Height of the walker at t seconds, m.
using HeightProfile = std::function<double(double)>;

/// What the air and the sensor add to the pressure of that height.
struct Air {
  double ground_pa = 101000.0;
  double temperature_k = 293.15;
  double noise_pa = 1.0;            ///< of one sample
  double drift_pa_per_hour = 30.0;  ///< weather
  double door_every_s = 0.0;        ///< a slam of 20 to 80 Pa for 0.2 to 1.7 s; 0: none
  unsigned seed = 1;
};

/// Pressure p0 (1 - L h / T0)^(g / R L), dry air of the standard lapse rate.
inline double pressure_at(double height_m, const Air& air) {
  return air.ground_pa * std::pow(1.0 - 0.0065 * height_m / air.temperature_k, 5.255876);
}

inline std::vector<PressureSample> read_pressure(const HeightProfile& height, double duration_s,
                                                 double rate_hz, const Air& air = {},
                                                 TimestampNs start_ns = 0) {
  std::mt19937 random(air.seed);
  std::normal_distribution<double> normal(0.0, air.noise_pa);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const bool doors = air.door_every_s > 0.0;
  double next_door = doors ? air.door_every_s * uniform(random) : duration_s;
  double shut = 0.0;
  double slam = 0.0;
  std::vector<PressureSample> samples;
  for (int i = 0; i <= static_cast<int>(duration_s * rate_hz); ++i) {
    const double t = i / rate_hz;
    if (t > next_door) {
      slam = (uniform(random) < 0.5 ? -1.0 : 1.0) * (20.0 + 60.0 * uniform(random));
      shut = t + 0.2 + 1.5 * uniform(random);
      next_door = t + air.door_every_s * (0.5 + uniform(random));
    }
    const double weather = air.drift_pa_per_hour * t / 3600.0 + (t < shut ? slam : 0.0);
    samples.push_back(
        {start_ns + to_ns(t), pressure_at(height(t), air) + weather + normal(random)});
  }
  return samples;
}

/// From `begin_s` on, `floors` storeys of two flights each at 0.3 m/s (up, or down where negative)
/// with 2.5 s on every landing.
inline HeightProfile stairs(double begin_s, int floors, double storey_m = 3.0) {
  return [=](double t) {
    const double flight_m = 0.5 * storey_m;
    const double flight_s = flight_m / 0.3;
    double left = std::max(0.0, t - begin_s);
    double climbed = 0.0;
    for (int flight = 0; flight < 2 * std::abs(floors) && left > 0.0; ++flight) {
      climbed += 0.3 * std::min(left, flight_s);
      left -= flight_s + 2.5;
    }
    return floors < 0 ? -climbed : climbed;
  };
}

/// A lift that leaves at `begin_s`, speeds up with 0.8 m/s^2 to 1.5 m/s and stops as it began.
inline HeightProfile lift(double begin_s, double rise_m) {
  return [=](double t) {
    constexpr double kSpeed = 1.5;
    constexpr double kAcceleration = 0.8;
    const double starting_s = kSpeed / kAcceleration;
    const double total_s = std::abs(rise_m) / kSpeed + starting_s;
    const double s = std::clamp(t - begin_s, 0.0, total_s);
    const double early = std::min(s, starting_s);
    const double late = std::max(0.0, s - (total_s - starting_s));
    const double climbed = kSpeed * (s - early) + 0.5 * kAcceleration * early * early -
                           0.5 * kAcceleration * late * late;
    return std::copysign(climbed, rise_m);
  };
}

}  // namespace vpdr::pdr::made
