#pragma once
// The magnetic field inside a building: the Earth's, bent by iron below the floor and by single
// steel objects along the walls. World ENU, microtesla.
#include <Eigen/Core>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/random.hpp"

namespace vpdr::simulation {

struct MagneticFieldOptions {
  double strength_ut = 48.0;     ///< of the Earth's field
  double dip_rad = 1.134;        ///< downward from the horizontal (65 degrees)
  double declination_rad = 0.0;  ///< magnetic from true north, positive east
  double disturbance_ut = 1.2;   ///< of the floor's iron, standard deviation along each axis
  double shortest_wave_m = 2.5;  ///< of that disturbance
  double longest_wave_m = 14.0;
  double objects_per_m = 0.025;     ///< steel doors, cabinets, pillars along a metre of wall
  double object_moment_am2 = 25.0;  ///< typical magnetic moment of one
};

/// The field of one building, the same at the same place for ever. Both parts are gradients of
/// harmonic potentials (curl and divergence are zero), as a static field outside iron is.
/// Thread-safe once made.
class MagneticField {
 public:
  MagneticField(const MagneticFieldOptions& options, const FloorPlan& plan, Random random);

  /// Field at a place, floor at z = 0.
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& place_m) const;
  /// The Earth's field alone.
  [[nodiscard]] const Eigen::Vector3d& undisturbed() const { return earth_; }

 private:
  /// Potential amplitude / k * cos(k . x + phase) * exp(-|k| (z - z0)).
  struct Wave {
    Eigen::Vector2d wave_number;
    double phase;
    double amplitude_ut;
  };
  struct Dipole {
    Eigen::Vector3d place_m;
    Eigen::Vector3d moment_am2;
  };

  Eigen::Vector3d earth_;
  std::vector<Wave> waves_;
  std::vector<Dipole> dipoles_;
};

}  // namespace vpdr::simulation
