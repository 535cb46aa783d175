#pragma once
// Sensor readings of a body that moves exactly as told: the truth of the tests of pdr.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::pdr::made {

/// Field of the tests, ENU, uT: 20 to the north, 40 down.
inline const Eigen::Vector3d kField(0.0, 20.0, -40.0);

/// Angles of the body and acceleration in the world at t seconds.
struct Motion {
  std::function<EulerAngles(double)> angles = [](double) { return EulerAngles{}; };
  std::function<double(double)> upward_mps2 = [](double) { return 0.0; };
  std::function<Eigen::Vector2d(double)> horizontal_mps2 = [](double) -> Eigen::Vector2d {
    return Eigen::Vector2d::Zero();
  };
};

struct Readings {
  std::vector<ImuSample> imu;
  std::vector<MagSample> mag;
  std::vector<Eigen::Quaterniond> truth;  ///< one for each inertial sample
};

/// Readings at `rate_hz`, without noise; the rate is that of the instant.
inline Readings read(const Motion& motion, double duration_s, double rate_hz,
                     TimestampNs start_ns = 0, bool with_field = true) {
  Readings out;
  const auto count = static_cast<int>(duration_s * rate_hz);
  for (int i = 0; i <= count; ++i) {
    const double t = i / rate_hz;
    const Eigen::Quaterniond q = from_euler(motion.angles(t));
    ImuSample sample;
    sample.stamp_ns = start_ns + to_ns(t);
    const Eigen::Vector2d across = motion.horizontal_mps2(t);
    sample.specific_force_mps2 =
        q.conjugate() *
        Eigen::Vector3d(across.x(), across.y(), kGravityMps2 + motion.upward_mps2(t));
    // Central difference of the attitude: the instant's rate.
    const double h = 1e-5;
    const Eigen::Quaterniond a = from_euler(motion.angles(t - h));
    const Eigen::Quaterniond b = from_euler(motion.angles(t + h));
    sample.angular_velocity_radps = log_rotation(a.conjugate() * b) / (2.0 * h);
    out.imu.push_back(sample);
    if (with_field) out.mag.push_back({sample.stamp_ns, q.conjugate() * kField});
    out.truth.push_back(q);
  }
  return out;
}

/// Upward acceleration of a walk of `steps_per_s` with a peak each 1 / steps_per_s from t = 0.
inline std::function<double(double)> bounce(double steps_per_s, double amplitude_mps2 = 3.0) {
  return [=](double t) { return amplitude_mps2 * std::cos(2.0 * kPi * steps_per_s * t); };
}

/// White noise on every reading, from a seed.
inline void add_noise(Readings& readings, double rate_radps, double force_mps2, double field_ut,
                      unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto vector = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(random), sigma * normal(random), sigma * normal(random));
  };
  for (ImuSample& s : readings.imu) {
    s.angular_velocity_radps += vector(rate_radps);
    s.specific_force_mps2 += vector(force_mps2);
  }
  for (MagSample& s : readings.mag) s.field_ut += vector(field_ut);
}

}  // namespace vpdr::pdr::made
