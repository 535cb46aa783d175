#pragma once
// How far the magnetic field can be trusted. The undisturbed field has a fixed horizontal and a
// fixed vertical part; both are learned. What is seen to be wrong in those two directions tells the
// size of what cannot be seen, the part across, which turns the heading: a disturbance has no
// preferred direction. So the heading's variance follows the disturbance, softly, and beyond a gate
// the field is not used at all. World axes (z up), microtesla.
// Not thread-safe; allocates nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct MagneticConfig {
  double sigma_ut = 0.7;           ///< uT, each direction of an undisturbed field; (0, 100)
  double initial_sigma_ut = 20.0;  ///< uT, before anything was learned; (0, 100)
  /// s, over which the error of an undisturbed field stays alike; (0.01, 600)
  double correlation_s = 4.5;
  /// s, over which a disturbance stays alike; (0.01, 600)
  double disturbance_correlation_s = 3.0;
  double disturbance_memory_s = 1.0;        ///< s, in which its size is forgotten; (0.01, 600)
  double reference_time_constant_s = 80.0;  ///< s, learning of the field; (1, 3600)
  double gate = 0.35;  ///< share of the field's strength beyond which it is not used; (0.05, 10)
  double declination_rad = 0.0;  ///< rad, magnetic north east of true north; (-pi, pi)
};

class MagneticReference {
 public:
  explicit MagneticReference(const MagneticConfig& config);

  /// What one field reading is worth.
  struct Judgement {
    bool usable = false;
    double innovation_rad = 0.0;  ///< turn that brings the field to magnetic north
    double variance_rad2 = 0.0;   ///< of that turn, disturbance correlation included
  };
  /// Judges the mean field of the last `dt_s` seconds, turned into world axes.
  Judgement judge(const Eigen::Vector3d& field_world_ut, double dt_s);

  /// True while the field differs from what was learned by more than the gate.
  [[nodiscard]] bool disturbed() const { return disturbed_; }
  [[nodiscard]] double horizontal_ut() const { return horizontal_ut_; }
  [[nodiscard]] double vertical_ut() const { return vertical_ut_; }

 private:
  void learn(double horizontal_ut, double vertical_ut, double dt_s);

  MagneticConfig config_;
  double horizontal_ut_ = 0.0;
  double vertical_ut_ = 0.0;
  double disturbance_ut2_;  ///< variance of one direction
  double age_s_ = 0.0;
  bool disturbed_ = false;
};

}  // namespace vpdr::pdr
