#pragma once
// Position from step length and walking direction: x += SL cos(theta), y += SL sin(theta) with a
// mathematical angle (S1.3). The AHRS paper's form (S3.5: 8, 9: north 0, clockwise, first direction
// +Y, X from the sine and Y from the cosine) is a view of the same state.
//
// One Kalman filter carries the position in odom, the frame of the relative yaw, together with
// everything that bends a whole walk, so that what is learned late corrects what was walked before,
// and the covariance is that of it all:
//
//   theta = relative yaw + lag + forward         (relative yaw: RelativeAttitude, gyroscope alone)
//   lag'  = -up bias                             (what is left of the gyroscope's, body axes)
//   l     = length (1 + scale) + white           (scale: the person's)
//   field = R(-lag) north + level_rows iron + disturbance + white
//   theta = corridor + white             (modulo a quarter turn, of straight stretches)
//
// north is the horizontal field of the earth in odom; its direction turns odom into the world, the
// whole walk with it. The filter is linear in it, so a wrong start is forgotten completely.
//
// The disturbance is what steel and cables do to the field of a building: alike over some metres of
// the way (first-order Gauss-Markov in the distance walked, not in time), a few microtesla strong.
// So a magnetometer says little within a few steps and much over a whole walk. The iron goes with
// the body: hard iron of the device that its calibration left over; turning tells it apart, and
// where it is beyond what a calibration leaves, the prior is widened as if from the start. A magnet
// nearby fails the gate: the disturbance is then taken anew and says nothing of heading. The
// noise of a field is learned from how neighbouring ones differ.
//
// World ENU, odom z up with arbitrary yaw; metres, radians, microtesla. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "pdr/core/attitude/field_average.hpp"
#include "pdr/core/attitude/known_field.hpp"
#include "pdr/core/attitude/relative_attitude.hpp"
#include "pdr/core/carry.hpp"
#include "pdr/core/heading/straight_stretches.hpp"

namespace vpdr::pdr {

struct DeadReckoningConfig {
  double forward_sigma_rad = 0.05;  ///< rad, of walking direction against the forward axis; (0, 3)
  double pocket_sigma_rad = 1.8;    ///< rad, the same of a board known to be in a pocket; (0, 3)
  double bias_sigma_radps = 0.004;  ///< rad/s, of the gyroscope, each axis, before any rest; (0, 1)
  double bias_walk_radps_sqrt_s = 2e-5;  ///< rad/s per sqrt(s), how it wanders; (0, 0.1)
  double rate_noise_rad_sqrt_s = 0.002;  ///< rad per sqrt(s), heading noise; (0, 0.1)
  double turn_error = 0.002;             ///< share of a turn: scale and cross-axis error; (0, 0.1)
  double rest_sigma_radps = 5e-4;        ///< rad/s, of the bias measured at rest; (0, 0.1)
  double sway_sigma_m = 0.05;            ///< m, of the body about where its steps put it; (0, 1)
  /// m, how far ahead a walker who seems to stand may be with a step under way; (0, 10)
  double unconfirmed_sigma_m = 0.5;
  double height_sigma_m = 0.5;  ///< m, of the height, which steps do not tell; (0, 100)
  double height_drift = 0.05;   ///< m of height per m walked: slopes, stairs; (0, 1)
};

/// The magnetic field as a walk sees it.
struct FieldConfig {
  double period_s = 0.25;             ///< s, of one mean field; (0.02, 10)
  double noise_ut = 1.0;              ///< uT, of a mean field, at least; (0, 100)
  double strength_ut = 30.0;          ///< uT, of the field before anything was measured; (0, 1000)
  double iron_sigma_ut = 3.0;         ///< uT, each axis, left over by calibration; (0, 100)
  double disturbance_sigma_ut = 7.0;  ///< uT, each direction, in a building; (0, 100)
  double disturbance_length_m = 7.0;  ///< m of the way over which it stays alike; (0.1, 1000)
  double standing_mps = 0.1;          ///< m/s, what time does to it without a step; (0, 10)
  double gate = 10.0;                 ///< normalised innovation squared, 2 dof; (1, 1000)
  double restart_sigma_ut = 20.0;     ///< uT, of a disturbance that is taken anew; (0, 1000)
};

/// With the forward axis as far from the walking direction as the place on the body lets it be.
[[nodiscard]] DeadReckoningConfig worn_at(DeadReckoningConfig config, Carry carry);

/// One step as dead reckoning needs it.
struct DeadReckonedStep {
  double length_m = 0.0;           ///< negative: back
  double relative_yaw_rad = 0.0;   ///< of the forward axis, in odom
  double scale_sigma = 0.0;        ///< share of the length, the same for all steps
  double length_noise_m = 0.0;     ///< of this step alone
  double heading_noise_rad = 0.0;  ///< of this step alone
};

class DeadReckoning {
 public:
  explicit DeadReckoning(const DeadReckoningConfig& config = {}, const FieldConfig& field = {},
                         double declination_rad = 0.0);

  /// S1.3.
  void add(const DeadReckonedStep& step);
  /// The walking direction is known to lie that far from the forward axis, and lay so ever since
  /// the start or carried_anew(): the track so far is turned about its start.
  void find_forward(double offset_rad, double variance_rad2);
  /// The first stretch, which is as wrong as the walking direction then is, says how the corridors
  /// lie; later ones along or across them correct the walk so far where the heading is sure enough
  /// to tell the two apart. Direction in the world.
  void take(const StraightStretch& stretch);
  /// The device is carried another way from now on: its forward axis is so far from the walking
  /// direction, nobody knows how.
  void carried_anew(double forward_sigma_rad);
  /// The same, and the forward axis is what it was but for so much.
  void carried_on(double variance_rad2);
  /// Time passed; a rest corrects the bias and with it the whole walk.
  void pass(const RelativeMotion& motion);
  /// Whoever walked when the samples failed may have gone so far since, any way.
  void stray(double distance_m);
  /// The first one makes yaw absolute: the track so far is turned about its start.
  void take(const MeanField& field);
  /// What calibration says of the undisturbed field. Unlike it, the first field says little of
  /// north, the less the more it differs.
  void expect(const KnownField& field) { known_ = field; }
  /// The device turns out to have iron of this variance, each axis, and had it ever since the
  /// start: north is as wrong as the fields that it was found from.
  void suspect_iron(double variance_ut2);

  /// East and north of the start, m. In odom until yaw is absolute.
  [[nodiscard]] Eigen::Vector2d position_m() const;
  /// Of east, north and the yaw of the attitude; m, rad.
  [[nodiscard]] Eigen::Matrix3d covariance() const;
  [[nodiscard]] double height_variance_m2() const;

  [[nodiscard]] bool yaw_is_absolute() const { return yaw_is_absolute_; }
  /// World yaw minus relative yaw: of the attitude, and of the walking direction.
  [[nodiscard]] double offset_rad() const { return world_from_odom_rad() + x_[kLag]; }
  [[nodiscard]] double walking_offset_rad() const { return offset_rad() + x_[kForward]; }
  [[nodiscard]] double walking_variance_rad2() const;
  /// Walking direction minus that of the forward axis, and whether it is known to within 20
  /// degrees.
  [[nodiscard]] double forward_rad() const { return x_[kForward]; }
  [[nodiscard]] bool knows_forward() const;
  /// The same without what is unsure of a device that points forward.
  [[nodiscard]] double zero_variance_rad2() const;
  /// Sum of the corrections of the walking direction that also corrected the walk so far.
  [[nodiscard]] double revision_rad() const { return revision_; }
  /// What the field is found to carry along with the body, uT.
  [[nodiscard]] Eigen::Vector3d iron_ut() const { return x_.segment<3>(kIron); }
  /// Fields so unlike the ones before that the disturbance was taken anew.
  [[nodiscard]] std::uint64_t field_restarts() const { return field_restarts_; }

  /// S3.5 (6): straight from the start, m.
  [[nodiscard]] double distance_m() const { return position_m().norm(); }
  /// S3.5 (7): along the path, m.
  [[nodiscard]] double path_length_m() const { return path_length_; }

  /// S3.5 (8): turn since the first step, theta_k = phi_k - phi_1, clockwise, [0, 2 pi).
  [[nodiscard]] double compass_turn_rad() const;
  /// S3.5 (9): X to the right of the first step's direction, Y along it, m.
  [[nodiscard]] Eigen::Vector2d compass_position_m() const;

 private:
  enum Index : std::uint8_t {
    kX,  ///< m, odom
    kY,
    kLag,
    kForward,
    kScale,
    kBias,  ///< rad/s, body axes
    kNorth = kBias + 3,
    kIron = kNorth + 2,
    kDisturbance = kIron + 3,
    kCorridor = kDisturbance + 2,  ///< rad, odom, modulo a quarter turn
    kSize
  };
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using FieldRows = Eigen::Matrix<double, 2, kSize>;

  [[nodiscard]] double world_from_odom_rad() const;
  /// Row r with r x = error of the attitude's yaw.
  [[nodiscard]] Vector yaw_row() const;
  void turn_errors(const Eigen::Matrix2d& rotation);
  void take_rest(const Eigen::Vector3d& bias_radps);
  void observe(const Vector& row, double innovation, double variance);
  void forget(Index index);
  void find_corridor(double direction_rad, double variance_rad2);
  void forget_corridor();
  void find_lag_again(const MeanField& field);
  double learn_noise(const Eigen::Vector2d& horizontal_ut);
  void pass_disturbance();
  void doubt_first(const MeanField& field);
  void doubt_impossible(const MeanField& field);
  void suspect_disturbance(double variance_ut2);
  void restart_disturbance(const Eigen::Vector2d& innovation_ut);
  void correct(const Vector& correction);
  void limit_lag_variance();
  void doubt_gyroscope();
  void doubt_calibration();

  DeadReckoningConfig config_;
  FieldConfig field_;
  double declination_;
  Vector x_ = Vector::Zero();
  Matrix p_ = Matrix::Zero();
  bool yaw_is_absolute_ = false;
  bool was_carried_anew_ = false;
  bool knows_corridor_ = false;
  bool doubts_gyroscope_ = false;
  double revision_ = 0.0;
  double since_field_m_ = 0.0;    ///< way since the last field
  double field_noise_ut2_ = 0.0;  ///< variance of a mean field, as learned
  std::optional<Eigen::Vector2d> last_field_;
  std::optional<KnownField> known_;  ///< by calibration
  double suspected_iron_ut2_;        ///< variance of each axis
  std::uint64_t field_restarts_ = 0;

  double path_length_ = 0.0;
  double first_yaw_ = 0.0;  ///< relative
  double last_yaw_ = 0.0;   ///< relative
  bool started_ = false;
};

/// S3.5 (10): Euclidean distance of an estimate from the truth, m.
double position_error_m(const Eigen::Vector2d& estimate_m, const Eigen::Vector2d& truth_m);

}  // namespace vpdr::pdr
