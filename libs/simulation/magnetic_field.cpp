#include "simulation/magnetic_field.hpp"

#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kWaves = 32;
constexpr double kReferenceHeightM = 1.4;  // where the disturbance has its nominal strength
constexpr double kMu0Over4PiUt = 0.1;      // in uT m^3 / (A m^2)

}  // namespace

MagneticField::MagneticField(const MagneticFieldOptions& options, const FloorPlan& plan,
                             Random random) {
  const double level = options.strength_ut * std::cos(options.dip_rad);
  earth_ = {level * std::sin(options.declination_rad), level * std::cos(options.declination_rad),
            -options.strength_ut * std::sin(options.dip_rad)};
  // A wave along a random direction shares its level field between east and north: variance
  // amplitude^2 / 4 on each.
  const double amplitude = options.disturbance_ut * 2.0 / std::sqrt(double{kWaves});
  for (int i = 0; i < kWaves; ++i) {
    const double length =
        options.shortest_wave_m *
        std::pow(options.longest_wave_m / options.shortest_wave_m, random.uniform());
    const double direction = random.uniform(0.0, 2.0 * kPi);
    const double phase = random.uniform(0.0, 2.0 * kPi);
    waves_.push_back({2.0 * kPi / length * Vector2d(std::cos(direction), std::sin(direction)),
                      phase, amplitude});
  }
  for (const Wall& wall : plan.walls()) {
    const Vector2d along = wall.end_m - wall.start_m;
    const int objects = static_cast<int>(along.norm() * options.objects_per_m + random.uniform());
    for (int i = 0; i < objects; ++i) {
      // Inside the wall or the room behind it, never in the walker's way.
      const Vector2d place =
          wall.start_m + random.uniform() * along - random.uniform(0.1, 0.6) * wall.normal;
      const double height = random.uniform(0.4, 1.8);
      Vector3d axis(random.normal(), random.normal(), random.normal());
      axis *= options.object_moment_am2 * random.uniform(0.4, 1.6) / axis.norm();
      dipoles_.push_back({{place.x(), place.y(), height}, axis});
    }
  }
}

Vector3d MagneticField::at(const Vector3d& place_m) const {
  Vector3d field = earth_;
  for (const Wave& wave : waves_) {
    const double k = wave.wave_number.norm();
    const double angle = wave.wave_number.dot(place_m.head<2>()) + wave.phase;
    const double strength = wave.amplitude_ut * std::exp(-k * (place_m.z() - kReferenceHeightM));
    field.head<2>() += strength * std::sin(angle) / k * wave.wave_number;
    field.z() += strength * std::cos(angle);
  }
  for (const Dipole& dipole : dipoles_) {
    const Vector3d offset = place_m - dipole.place_m;
    const double squared = offset.squaredNorm();
    if (squared > 64.0) continue;  // below 0.01 uT from here on
    const double distance = std::sqrt(squared);
    field += kMu0Over4PiUt / (squared * distance) *
             (3.0 * dipole.moment_am2.dot(offset) / squared * offset - dipole.moment_am2);
  }
  return field;
}

}  // namespace vpdr::simulation
