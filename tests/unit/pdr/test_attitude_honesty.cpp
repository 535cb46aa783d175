// The covariance says how wrong the attitude is: over many simulated walks with sensors as bad as
// the configuration says, the mean of e' P^-1 e / 3 (NEES) is one, within its 95 % band.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "attitude_run.hpp"
#include "core/rotation.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A walker whose velocity wanders (correlation 1 s, 0.7 m/s each axis) while the board turns;
/// bias, scale and noise of the gyroscope drawn from what the configuration says of them.
class Walk {
 public:
  Walk(const AttitudeErrorConfig& config, unsigned seed) : random_(seed), config_(config) {
    bias_ = draw(config.initial_bias_sigma_radps);
    scale_ = Vector3d::Ones() + draw(config.initial_scale_sigma);
    offset_ = draw(kGravityMps2 * config.base_sigma_rad);
    magnet_ = draw(MagneticOffsetConfig{}.prior_sigma_ut);
    turning_ = draw(1.0);
    phase_ = draw(3.0);
    field_error_ = draw(1.0);
    velocity_ = draw(0.7);
  }

  /// Fills the readings of the next sample and its truth.
  void next(ImuSample& imu, MagSample& mag, Quaterniond& truth) {
    t_ += kStep;
    truth = attitude(t_);
    const Vector3d rate =
        log_rotation(attitude(t_ - 1e-4).conjugate() * attitude(t_ + 1e-4)) / 2e-4;
    const double white = config_.rate_noise_rad_sqrt_s / std::sqrt(kStep);
    imu.stamp_ns = to_ns(t_);
    imu.angular_velocity_radps = rate.cwiseQuotient(scale_) + bias_ +
                                 config_.turning_error * rate.norm() * turning_ + draw(white);
    turning_ += -kStep * turning_ + draw(std::sqrt(2.0 * kStep));  // alike for 1 s

    const Vector3d before = velocity_;
    velocity_ += -kStep * velocity_ + draw(0.7 * std::sqrt(2.0 * kStep));
    imu.specific_force_mps2 =
        truth.conjugate() * ((velocity_ - before) / kStep + Vector3d(0.0, 0.0, kGravityMps2)) +
        offset_;
    field_error_ += -kStep / 2.0 * field_error_ + draw(std::sqrt(kStep));
    mag.stamp_ns = imu.stamp_ns;
    mag.field_ut = truth.conjugate() * (made::kField + 1.5 * field_error_) + magnet_;
  }

  static constexpr double kStep = 0.01;

 private:
  Vector3d draw(double sigma) {
    return sigma * Vector3d(normal_(random_), normal_(random_), normal_(random_));
  }
  [[nodiscard]] Quaterniond attitude(double t) const {
    return from_euler({0.4 * std::sin(1.3 * t + phase_.x()), 0.3 * std::sin(1.9 * t + phase_.y()),
                       1.2 * std::sin(0.4 * t + phase_.z()) + 0.2 * t});
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  AttitudeErrorConfig config_;
  Vector3d bias_, scale_, offset_, magnet_, turning_, phase_, field_error_, velocity_;
  double t_ = 0.0;
};

TEST(AttitudeHonesty, NeesOfSimulatedWalksIsInsideItsBand) {
  constexpr int kWalks = 60;
  AttitudeConfig config = made::prompt_sensors();
  config.error.timing_sigma_s = 1e-6;
  config.error.base_sigma_rad = 0.005;
  double sum = 0.0;
  double inclination = 0.0;
  double heading = 0.0;
  for (unsigned seed = 0; seed < kWalks; ++seed) {
    Walk walk(config.error, seed + 100);
    AttitudeFilter filter(config);
    Quaterniond truth;
    for (int i = 0; i < 6000; ++i) {
      ImuSample imu;
      MagSample mag;
      walk.next(imu, mag, truth);
      filter.process(mag);
      filter.process(imu);
    }
    const AttitudeEstimate estimate = filter.estimate();
    const Vector3d e = log_rotation(truth * estimate.world_from_body.conjugate());
    const Eigen::Matrix3d& p = estimate.covariance_rad2;
    sum += e.dot(p.inverse() * e) / 3.0;
    inclination += e.head<2>().dot(p.topLeftCorner<2, 2>().inverse() * e.head<2>()) / 2.0;
    heading += e.z() * e.z() / p(2, 2);
  }
  std::printf("NEES of %d walks: %.2f, inclination %.2f, heading %.2f\n", kWalks, sum / kWalks,
              inclination / kWalks, heading / kWalks);
  // chi^2 of 180 degrees of freedom over 180: 0.80 to 1.22.
  EXPECT_GT(sum / kWalks, 0.80);
  EXPECT_LT(sum / kWalks, 1.22);
}

}  // namespace
}  // namespace vpdr::pdr
