#pragma once
// How far the magnetic field can be trusted. Once the board's own offset (MagneticOffset) is taken
// off, the undisturbed field has a fixed horizontal and a fixed vertical part. What is seen to be
// wrong in those two directions tells the size of what cannot be seen, the part across, which turns
// the heading: a disturbance has no preferred direction. So the heading's variance follows the
// disturbance, softly, and beyond a gate the field is not used at all. The reference is the field
// of the recent past, which odd readings hardly move: no field is wrong for ever, none is believed
// at once. Where the offset turns out to be another than was thought possible, the heading that
// followed the readings is as wrong, which is told once. A field known from calibration is a recent
// past to begin with, and fades as such. World axes (z up), microtesla. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>

#include "pdr/core/attitude/known_field.hpp"
#include "pdr/core/attitude/magnetic_delay.hpp"
#include "pdr/core/attitude/magnetic_offset.hpp"

namespace vpdr::pdr {

struct MagneticConfig {
  double sigma_ut = 1.5;              ///< uT, each direction of an undisturbed field; (0, 100)
  double initial_sigma_ut = 20.0;     ///< uT, before anything was learned; (0, 100)
  double correlation_s = 1.5;         ///< s, over which a field's error stays alike; (0.01, 600)
  double disturbance_memory_s = 1.0;  ///< s, over which a disturbance is judged; (0.01, 600)
  double gate = 0.2;  ///< share of the field's strength beyond which it is not used; (0.05, 10)
  double declination_rad = 0.0;  ///< rad, magnetic north east of true north; (-pi, pi)
  double delay_s = 0.01;         ///< s, by which a field is older than its stamp; [0, 0.2)
  double known_field_s = 60.0;   ///< s of readings that a calibrated field stands for; [0, 3600)
  MagneticOffsetConfig offset;
  MagneticDelayConfig delay;
};

class MagneticReference {
 public:
  explicit MagneticReference(const MagneticConfig& config);

  /// What one field reading is worth.
  struct Judgement {
    bool usable = false;
    Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();  ///< world axes, offset taken off
    double innovation_rad = 0.0;                         ///< turn that brings it to north
    double variance_rad2 = 0.0;  ///< of that turn, correlation of its error included
    /// How the turn changes with the estimate's tilt about world x and y: the dip comes in.
    Eigen::Vector2d tilt_row = Eigen::Vector2d::Zero();
    /// Of a heading that followed the readings until now, once: the offset taken off them turns
    /// out to have been another than was thought possible. Told of unusable readings as well.
    double stale_rad2 = 0.0;
  };
  /// Mean of readings, world axes.
  struct Readings {
    Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();
    Eigen::Vector3d slope_utps = Eigen::Vector3d::Zero();  ///< how it changes with delay_s()
    Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Identity();
  };
  /// Judges the mean field of the last `dt_s` seconds.
  Judgement judge(const Readings& readings, double dt_s);

  /// What calibration says of the undisturbed field; best before the first judgement.
  void expect(const KnownField& field);

  /// After a gap the heading may be another: the field is learned anew.
  void restart() { offset_.restart(); }
  /// Turns the memory with the world frame: call with every correction that the attitude takes.
  void turn(const Eigen::Matrix3d& world_from_old_world) { offset_.turn(world_from_old_world); }

  /// True while the field differs from the reference by more than the gate.
  [[nodiscard]] bool disturbed() const { return disturbed_; }
  [[nodiscard]] const MagneticOffset& offset() const { return offset_; }
  /// By which a field is older than its stamp, as far as it is known.
  [[nodiscard]] double delay_s() const { return config_.delay_s + delay_.excess_s(); }
  [[nodiscard]] const MagneticDelay& delay() const { return delay_; }

 private:
  void learn_delay(const Readings& readings, double dt_s);
  void follow_disturbance(const Eigen::Vector3d& field_ut, double dt_s);
  [[nodiscard]] KnownField usual(double dt_s);
  double find_stale(const Eigen::Matrix3d& world_from_body);
  void follow(const Eigen::Vector3d& field_ut, double dt_s);
  [[nodiscard]] double variance_across(const Eigen::Vector3d& field_ut,
                                       const Eigen::Matrix3d& world_from_body, double dt_s) const;

  MagneticConfig config_;
  MagneticOffset offset_;
  MagneticDelay delay_;
  KnownField known_;             ///< by calibration
  double known_weight_s_ = 0.0;  ///< 0: not known, or faded
  double disturbance_ut2_;       ///< variance of one direction
  bool disturbed_ = false;
  Eigen::Vector3d trusted_offset_ = Eigen::Vector3d::Zero();  ///< that headings rest on
  Eigen::Matrix3d trusted_information_;                       ///< of that, 1/uT^2
  KnownField followed_;                                       ///< mean of what turned the heading
  double followed_weight_s_ = 0.0;                            ///< of undisturbed readings
};

}  // namespace vpdr::pdr
