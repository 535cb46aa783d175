#pragma once
// What the integrated gyroscope gets wrong, as one error-state Kalman filter: attitude error (rad,
// rotation vector in world axes, truth from estimate), gyroscope bias (rad/s, body axes), scale
// error of each gyroscope axis, and horizontal velocity (m/s, world axes).
//
// Gravity comes in through the velocity. Specific force is turned into the almost inertial frame
// that the gyroscope keeps and integrated there; a tilt of the horizon makes that velocity run away
// as g times the tilt, while a person's true velocity stays small and changes its direction. So
// steps and gestures average out by themselves, the time over which they do follows from the
// speeds seen, and what tilts the horizon (bias, scale) is learned in motion. The field corrects
// heading, bias and scale, never tilt or velocity: their gains are held at zero and the covariance
// says so (Schmidt's consider filter).
//
// A bias far beyond its prior is a bad gyroscope's: the prior is widened as if from the start.
//
// Its noises are those of the worst: a magnet near by, a runner. How much less it is here and now
// its own corrections tell (CorrectionScale), and the covariance that it reports is scaled by that.
// What no correction ever shows is added: base and timing.
//
// World ENU, body forward-left-up, SI. Corrections gather in the state; take_turn() hands the
// attitude part over. Not thread-safe; allocates nothing.
#include <Eigen/Core>

#include "pdr/core/attitude/correction_scale.hpp"
#include "pdr/core/attitude/horizon_base.hpp"

namespace vpdr::pdr {

struct AttitudeErrorConfig {
  double initial_tilt_sigma_rad = 0.05;    ///< rad, of coarse levelling, at most; (0, 3)
  double least_tilt_sigma_rad = 0.02;      ///< rad, of coarse levelling, at least; (0, 3)
  double initial_bias_sigma_radps = 0.01;  ///< rad/s, each axis at the start; (0, 1)
  double initial_scale_sigma = 0.01;       ///< scale error of each axis at the start; (0, 0.2)
  double bias_walk_radps_sqrt_s = 3e-5;    ///< rad/s per sqrt(s), how the bias wanders; (0, 0.1)
  double rate_noise_rad_sqrt_s = 0.002;    ///< rad per sqrt(s), of each axis; (0, 0.1)
  double turning_error = 0.002;            ///< share of the rate: cross-axis error; (0, 0.1)
  double force_noise_mps2_sqrt_s = 0.05;   ///< m/s per sqrt(s), accelerometer noise; (0, 10)
  double usual_speed_mps = 1.0;            ///< m/s, each axis, before any was seen; (0.01, 20)
  double least_speed_mps = 0.1;            ///< m/s, of the calmest movement; (0.001, 10)
  double speed_correlation_s = 1.0;        ///< s, over which a velocity stays alike; (0.01, 60)
  double speed_memory_s = 6.0;             ///< s, over which the speed is judged; (0.1, 600)
  double rest_speed_mps = 0.02;            ///< m/s, at rest; (1e-4, 1)
  double rest_sigma_radps = 3e-4;          ///< rad/s, of one mean rate at rest; (0, 0.1)
  double no_gyro_rate_radps = 0.5;         ///< rad/s, turning of a body without one; (0, 10)
  double heading_tolerance_rad = 0.1;      ///< rad, a field that differs less is as usual; (0, 3)
  double heading_surprise = 5.0;           ///< variances beyond which a field counts less; (1, 1e6)
  double heading_base_sigma_rad = 0.022;   ///< rad, of the place's north and mounting; [0, 1)
  double timing_sigma_s = 0.008;           ///< s, of the delay, as long as unknown; (0, 0.1)
  double largest_bias_radps = 0.1;         ///< rad/s, held within; (0, 1)
  HorizonBaseConfig base;
  CorrectionScaleConfig scale;
};

class AttitudeErrorFilter {
 public:
  explicit AttitudeErrorFilter(const AttitudeErrorConfig& config);

  /// What the strapdown integration gathered over `duration_s` seconds.
  struct Motion {
    double duration_s = 0.0;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();  ///< integral of world-from-body, s
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();  ///< integral of its columns times rate, rad
    Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< integral of specific force, world
    double turned_rad = 0.0;                                 ///< about any axis
    bool has_gyro = true;
  };
  void predict(const Motion& motion);
  /// A person's velocity is small, or known to differ little from `expected_mps` (world axes); at
  /// rest it is none.
  void correct_velocity(double duration_s, bool at_rest,
                        const Eigen::Vector2d& expected_mps = Eigen::Vector2d::Zero());
  /// The mean rate at rest is the bias.
  void correct_at_rest(const Eigen::Vector3d& mean_rate_radps);
  /// Heading measured: innovation rad (measured minus the estimate, pending turn not applied), its
  /// variance rad^2, and how much it changes with the estimate's tilt about world x and y.
  /// Disagreement with what the gyroscope carried on makes it count less.
  void correct_heading(double innovation_rad, double variance_rad2,
                       const Eigen::Vector2d& tilt_row);

  /// Heading set to a measured value outright by turning the world frame by `angle_rad`.
  void align_heading(double angle_rad, double variance_rad2);
  /// What is known of the sensors' delay: its variance.
  void set_timing_variance(double variance_s2) { timing_variance_s2_ = variance_s2; }
  /// Readings at their limit: velocity or attitude changed by an unknown amount.
  void add_velocity_variance(double variance_m2ps2);
  void add_attitude_variance(double variance_rad2);
  /// The fields that the heading followed were wrong by as much.
  void add_heading_variance(double variance_rad2);
  /// The horizon has just been set: tilt is known to `tilt_sigma_rad`, within what is configured.
  void level(double tilt_sigma_rad);
  /// After a gap: tilt starts anew, the body has turned by about `sigma_rad`.
  void restart(double sigma_rad);
  /// What was learned of the gyroscope may be wrong: it is as unsure as at the start.
  void doubt_gyroscope();

  /// Rotation (world axes) that brings the estimate to what is known now; zero afterwards.
  Eigen::Vector3d take_turn();

  [[nodiscard]] const Eigen::Vector3d& bias_radps() const { return bias_; }
  /// Factor of each axis on a rate whose bias has been removed.
  [[nodiscard]] const Eigen::Vector3d& scale() const { return scale_; }
  /// Of the attitude, world axes, while the body turns at `rate_radps` (world axes): what is
  /// known of the filter's own error, scaled, and what never averages out.
  [[nodiscard]] Eigen::Matrix3d covariance_rad2(const Eigen::Vector3d& rate_radps) const;
  /// The larger one of the horizon's two, unscaled.
  [[nodiscard]] double tilt_variance_rad2() const {
    return covariance_.diagonal().head<2>().maxCoeff();
  }
  [[nodiscard]] Eigen::Matrix3d bias_covariance() const { return covariance_.block<3, 3>(3, 3); }

 private:
  /// Attitude x y z, bias x y z, scale x y z, velocity x y, and one that stays zero: columns of an
  /// even length are added two numbers at a time.
  static constexpr int kSize = 12;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  void add_process_noise(const Motion& motion);
  void measure(int index, double innovation, double variance);
  void measure_velocity(const Eigen::Vector2d& measured_mps, double variance);
  void subtract(const Vector& a, const Vector& b, const Vector& c, const Vector& d);
  void forget_tilt_and_velocity(double tilt_sigma_rad);
  void set_heading_variance(double variance_rad2);
  void bound_heading_variance();
  void suspect_gyroscope();

  AttitudeErrorConfig config_;
  Eigen::Vector3d up_in_body_ = Eigen::Vector3d::UnitZ();  ///< of the last motion
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  HorizonBase base_;
  CorrectionScale tilt_scale_;
  CorrectionScale heading_scale_;
  double timing_variance_s2_;
  double bias_prior_;      ///< (rad/s)^2, each axis
  double speed_variance_;  ///< (m/s)^2, each axis, as seen
  bool at_rest_ = false;   ///< rest tells nothing of how wrong a movement makes it
};

}  // namespace vpdr::pdr
