#pragma once
// Attitude from gyroscope, accelerometer and magnetometer. The gyroscope's rate is integrated over
// the true time between samples; every correction period what has gathered goes through one error
// filter (AttitudeErrorFilter): gravity levels the horizon and finds bias and scale of the
// gyroscope, rest gives the bias outright, and the field, as far as MagneticReference trusts it,
// turns the heading only. The AHRS paper's complementary filter (S3.3, ComplementaryFilter) may be
// chosen in its place as a baseline.
//
// Sensors low-pass what they measure, so that readings are older than their stamps:
// `sensor_delay_s` is made up for by turning the published attitude on at the present rate.
//
// Body forward-left-up, world ENU, SI, radians. Without a magnetometer yaw starts at zero and is
// relative. Samples are expected to have passed a SampleGate; a non-finite one is ignored all the
// same. Magnetometer samples are used with the first inertial sample that is later than they,
// turned back to their own time; so the order of arrival of equal stamps does not matter. Not
// thread-safe; allocates nothing, throws nothing.
//
//   AttitudeFilter filter(AttitudeConfig{});
//   filter.process(mag);
//   filter.process(imu);
//   AttitudeEstimate now = filter.estimate();
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/estimates.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/attitude_error_filter.hpp"
#include "pdr/core/attitude/coarse_levelling.hpp"
#include "pdr/core/attitude/complementary_filter.hpp"
#include "pdr/core/attitude/frozen_rate.hpp"
#include "pdr/core/attitude/horizon_watch.hpp"
#include "pdr/core/attitude/magnetic_reference.hpp"
#include "pdr/core/attitude/rest_detector.hpp"
#include "pdr/core/attitude/saturation_detector.hpp"

namespace vpdr::pdr {

enum class AttitudeMethod : std::uint8_t {
  kErrorState,     ///< the default
  kComplementary,  ///< the AHRS paper's filter as printed (S3.3)
};

struct AttitudeConfig {
  AttitudeMethod filter = AttitudeMethod::kErrorState;
  bool use_magnetometer = true;
  /// s, by which inertial readings are older than their stamps: the low-pass in the sensor (4.8 ms
  /// in an MPU6050 at 42 Hz); [0, 0.2)
  double sensor_delay_s = 0.005;
  double correction_period_s = 0.04;   ///< s, between corrections; (0.005, 1)
  double heading_period_s = 0.12;      ///< s, at least, between those of heading; [0, 1)
  double levelling_s = 1.0;            ///< s, at the start: the mean force is upright; [0, 60)
  double gap_s = 0.5;                  ///< s, a longer silence is not integrated over; (0.05, 10)
  double gap_rate_radps = 0.5;         ///< rad/s, how much the body may have turned in it; (0, 10)
  double saturated_force_mps2 = 10.0;  ///< m/s^2, beyond the accelerometer's limit; (0, 1000)
  double saturated_rate_radps = 5.0;   ///< rad/s, beyond the gyroscope's limit; (0, 100)
  AttitudeErrorConfig error;
  MagneticConfig magnetic;
  RestConfig rest;
  ComplementaryConfig complementary;
};

class AttitudeFilter {
 public:
  explicit AttitudeFilter(const AttitudeConfig& config = {});

  /// The first sample sets the inclination; each later one moves the attitude to its stamp.
  void process(const ImuSample& sample);
  void process(const MagSample& sample);
  /// What calibration says of the undisturbed field.
  void expect(const KnownField& field) { magnetic_.expect(field); }
  /// The body moves about so, body axes, until told otherwise: none unless told.
  void expect_velocity(const Eigen::Vector3d& body_mps) { expected_mps_ = body_mps; }

  [[nodiscard]] bool initialised() const { return initialised_; }
  /// As the readings tell it, i.e. `sensor_delay_s` ago.
  [[nodiscard]] const Eigen::Quaterniond& world_from_body() const { return world_from_body_; }
  /// At the last sample's stamp: attitude, covariance, bias-free rate, bias and flags.
  [[nodiscard]] AttitudeEstimate estimate() const;

  [[nodiscard]] bool at_rest() const { return rest_.at_rest(); }
  [[nodiscard]] bool magnetically_disturbed() const { return magnetic_.disturbed(); }
  [[nodiscard]] const Eigen::Vector3d& bias_radps() const { return error_.bias_radps(); }
  [[nodiscard]] const AttitudeErrorFilter& error() const { return error_; }
  [[nodiscard]] const MagneticReference& magnetic() const { return magnetic_; }
  /// Magnetometer samples that came too late or too many at once to be used.
  [[nodiscard]] std::uint64_t dropped_fields() const { return dropped_fields_; }
  /// Turn about the vertical that the last sample's corrections applied, rad.
  [[nodiscard]] double last_heading_correction_rad() const { return last_heading_correction_; }
  /// True when the last sample's correction made yaw absolute for the first time.
  [[nodiscard]] bool just_aligned() const { return just_aligned_; }
  /// Variance of what the body turned without the last sample's gyroscope seeing it: an axis is
  /// stuck, or the horizon was found lost.
  [[nodiscard]] double lost_turn_rad2() const { return lost_turn_rad2_; }

 private:
  /// Magnetometer readings that gather between two corrections, turned into the world.
  struct Fields {
    Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();         ///< sum
    Eigen::Vector3d slope_utps = Eigen::Vector3d::Zero();       ///< sum, its change with the delay
    Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Zero();  ///< sum
    int count = 0;
  };

  void initialise(const ImuSample& sample);
  void integrate(const ImuSample& sample, double dt_s);
  void watch_frozen(const ImuSample& sample, double dt_s);
  void watch_limits(const ImuSample& sample, double dt_s);
  void pass_gap(const ImuSample& sample, double gap_s);
  void take_fields(const ImuSample& sample);
  void take_field(const MagSample& sample, double age_s);
  void correct(bool has_gyro);
  void level_coarsely();
  [[nodiscard]] bool horizon_is_lost(bool has_gyro);
  void lose_horizon();
  void restart_surroundings();
  void correct_heading();
  void align_heading(const MagneticReference::Judgement& judgement);
  void apply_correction();
  void step_complementary(const ImuSample& sample, double dt_s);
  [[nodiscard]] Eigen::Quaterniond complementary_measurement() const;

  AttitudeConfig config_;
  AttitudeErrorFilter error_;
  MagneticReference magnetic_;
  RestDetector rest_;
  SaturationDetector force_limit_;
  SaturationDetector rate_limit_;
  FrozenRate frozen_;
  ComplementaryFilter complementary_;

  bool initialised_ = false;
  bool yaw_is_absolute_ = false;
  bool just_aligned_ = false;
  double last_heading_correction_ = 0.0;
  double lost_turn_rad2_ = 0.0;
  Eigen::Quaterniond world_from_body_ = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();  ///< of that, at the last sample
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();          ///< of the last sample, bias-free
  Eigen::Vector3d expected_mps_ = Eigen::Vector3d::Zero();  ///< velocity, body axes
  ImuSample last_sample_;
  AttitudeErrorFilter::Motion motion_;
  Fields fields_;
  CoarseLevelling levelling_;  ///< since the start or the last gap
  HorizonWatch horizon_watch_;
  double field_interval_s_ = 0.0;  ///< since the last correction of heading
  TimestampNs last_field_ns_ = 0;
  bool has_field_ = false;
  Eigen::Vector3d last_field_ut_ = Eigen::Vector3d::Zero();

  std::array<MagSample, 16> pending_{};
  std::size_t pending_count_ = 0;
  std::uint64_t dropped_fields_ = 0;
};

}  // namespace vpdr::pdr
