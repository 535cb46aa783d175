#pragma once
// What the gyroscope gets wrong: a Kalman filter over the heading error (rad, counter-clockwise,
// truth minus estimate) and the bias of the three axes (rad/s, body axes). It is the slow part of
// the complementary filter (S3.3): the magnetometer corrects heading with the share its
// uncertainty earns and nothing else, rest and the drift of the inclination give the bias.
// Not thread-safe; allocates nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct GyroErrorConfig {
  double initial_bias_sigma_radps = 0.01;  ///< rad/s, each axis at the start; (0, 1)
  double bias_walk_radps_sqrt_s = 3e-5;    ///< rad/s per sqrt(s), how the bias wanders; (0, 0.1)
  double rate_noise_rad_sqrt_s = 0.01;     ///< rad per sqrt(s), heading noise; (0, 0.1)
  double scale_error = 0.0015;             ///< of the rate: scale and cross-axis error; (0, 0.1)
  double rest_sigma_radps = 3e-4;          ///< rad/s, of one mean rate at rest; (0, 0.1)
  double drift_sigma_radps = 0.012;        ///< rad/s, of inclination drift over 1 s; (0, 1)
  double largest_bias_radps = 0.1;         ///< rad/s, held within; (0, 1)
};

class GyroErrorFilter {
 public:
  explicit GyroErrorFilter(const GyroErrorConfig& config);

  /// `dt_s` seconds passed; `up_in_body` is the mean direction of the vertical in body axes (third
  /// row of world-from-body), `turned_rad` the angle turned about any axis.
  void predict(double dt_s, const Eigen::Vector3d& up_in_body, double turned_rad);
  /// Heading became less certain, e.g. by a gap, rad^2.
  void add_heading_variance(double variance_rad2);

  /// Heading measured: innovation rad (measured minus estimate), variance rad^2. Returns the angle
  /// by which the estimate must be turned (counter-clockwise).
  double correct_heading(double innovation_rad, double variance_rad2);
  /// Heading set to a measured value outright.
  void set_heading_variance(double variance_rad2);
  /// The mean rate at rest is the bias. Returns the turn of the heading that goes with it.
  double correct_at_rest(const Eigen::Vector3d& mean_rate_radps);
  /// Inclination drifts by what the bias is wrong: `drift_radps` is the mean rate of the
  /// inclination correction about world x and y over `dt_s`, `level_rows` the two first rows of the
  /// mean world-from-body. Returns the turn of the heading that goes with it.
  double correct_from_drift(const Eigen::Vector2d& drift_radps,
                            const Eigen::Matrix<double, 2, 3>& level_rows, double dt_s);

  [[nodiscard]] const Eigen::Vector3d& bias_radps() const { return bias_; }
  [[nodiscard]] double heading_variance_rad2() const { return covariance_(0, 0); }
  [[nodiscard]] Eigen::Matrix3d bias_covariance() const {
    return covariance_.bottomRightCorner<3, 3>();
  }

 private:
  using Vector4 = Eigen::Vector4d;
  /// One scalar measurement; returns the heading part of the correction, applies the bias part.
  double update(const Vector4& row, double innovation, double variance);

  GyroErrorConfig config_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();  ///< heading, bias x y z
};

}  // namespace vpdr::pdr
