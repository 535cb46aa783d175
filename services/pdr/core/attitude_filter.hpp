#pragma once
// Attitude from gyroscope, accelerometer and magnetometer: the complementary filter of the AHRS
// paper on quaternions (S3.3: 1, 2): C = C_0 G_1 + C_w G_2, with C_w the integrated gyroscope, C_0
// what accelerometer and magnetometer say, and G_1 + G_2 = 1. Its rate is integrated over the true
// time between samples, exactly or by the paper's first-order Runge-Kutta step. Specific force
// corrects the inclination (InclinationFilter), the field corrects heading only
// (MagneticReference), and the bias comes from rest and from the drift of the inclination
// (GyroErrorFilter).
//
// Body forward-left-up, world ENU, SI, radians. Without a magnetometer yaw starts at zero and is
// relative. Samples are expected to have passed a SampleGate. Magnetometer samples are used with
// the first inertial sample that is later than they, turned back to their own time; so the order of
// arrival of equal stamps does not matter. Not thread-safe; allocates nothing, throws nothing.
//
//   AttitudeFilter filter(AttitudeConfig{});
//   filter.process(mag);
//   filter.process(imu);
//   Eigen::Quaterniond q = filter.world_from_body();
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/estimates.hpp"
#include "core/samples.hpp"
#include "pdr/core/gyro_error_filter.hpp"
#include "pdr/core/inclination_filter.hpp"
#include "pdr/core/magnetic_reference.hpp"
#include "pdr/core/rest_detector.hpp"

namespace vpdr::pdr {

/// How the rate is integrated into the quaternion.
enum class RateIntegration : std::uint8_t {
  kExponential,           ///< exact for a constant rate between samples
  kFirstOrderRungeKutta,  ///< q + q (0, w) dt / 2, normalised, as the paper prints it
};

struct AttitudeConfig {
  RateIntegration integration = RateIntegration::kExponential;
  bool use_magnetometer = true;
  double correction_period_s = 0.04;  ///< s, between corrections; (0.005, 1)
  double gap_s = 0.5;                 ///< s, a longer silence is not integrated over; (0.05, 10)
  double gap_rate_radps = 0.5;        ///< rad/s, how much the body may have turned in it; (0, 10)
  double no_gyro_rate_radps = 0.5;    ///< rad/s, turning of a body without gyroscope; (0, 10)
  InclinationConfig inclination;
  MagneticConfig magnetic;
  GyroErrorConfig gyro_error;
  RestConfig rest;
};

class AttitudeFilter {
 public:
  explicit AttitudeFilter(const AttitudeConfig& config = {});

  /// The first sample sets the inclination; each later one moves the attitude to its stamp.
  void process(const ImuSample& sample);
  void process(const MagSample& sample);

  [[nodiscard]] bool initialised() const { return initialised_; }
  [[nodiscard]] const Eigen::Quaterniond& world_from_body() const { return world_from_body_; }
  /// Of the last sample: attitude, covariance and bias-free rate.
  [[nodiscard]] AttitudeEstimate estimate() const;

  [[nodiscard]] bool at_rest() const { return rest_.at_rest(); }
  [[nodiscard]] bool magnetically_disturbed() const { return magnetic_.disturbed(); }
  [[nodiscard]] const Eigen::Vector3d& bias_radps() const { return gyro_error_.bias_radps(); }
  /// Magnetometer samples that came too late or too many at once to be used.
  [[nodiscard]] std::uint64_t dropped_fields() const { return dropped_fields_; }
  /// Turn about the vertical that the last sample's corrections applied, rad.
  [[nodiscard]] double last_heading_correction_rad() const { return last_heading_correction_; }
  /// True when the last sample's correction made yaw absolute for the first time.
  [[nodiscard]] bool just_aligned() const { return just_aligned_; }

 private:
  /// What gathers between two corrections.
  struct Block {
    double duration_s = 0.0;
    Eigen::Vector3d force_world = Eigen::Vector3d::Zero();      ///< integral
    Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Zero();  ///< integral
    Eigen::Vector3d field_world = Eigen::Vector3d::Zero();      ///< sum
    int fields = 0;
    double turned_rad = 0.0;  ///< about any axis
  };

  void initialise(const ImuSample& sample);
  void integrate(const ImuSample& sample, double dt_s);
  void pass_gap(const ImuSample& sample, double gap_s);
  void take_fields(const ImuSample& sample);
  void correct(bool has_gyro);
  void correct_inclination(const Block& block, bool has_gyro);
  void correct_heading(const Block& block);
  void align_heading(const Eigen::Vector3d& field_world_ut, double variance_rad2);
  void correct_bias_at_rest();
  void turn_heading(double angle_rad);

  AttitudeConfig config_;
  InclinationFilter inclination_;
  MagneticReference magnetic_;
  GyroErrorFilter gyro_error_;
  RestDetector rest_;

  bool initialised_ = false;
  bool yaw_is_absolute_ = false;
  bool just_aligned_ = false;
  double last_heading_correction_ = 0.0;
  Eigen::Quaterniond world_from_body_ = Eigen::Quaterniond::Identity();
  ImuSample last_sample_;
  Block block_;
  Eigen::Matrix<double, 2, 3> slow_level_rows_ = Eigen::Matrix<double, 2, 3>::Zero();
  double field_interval_s_ = 0.0;  ///< since the last field was used

  std::array<MagSample, 16> pending_{};
  std::size_t pending_count_ = 0;
  std::uint64_t dropped_fields_ = 0;
};

}  // namespace vpdr::pdr
