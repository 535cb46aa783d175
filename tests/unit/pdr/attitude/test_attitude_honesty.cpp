// The covariance says how wrong the attitude is: over many simulated walks with sensors as bad as
// the configuration says, the mean of e' P^-1 e / 3 (NEES) is one, within its 95 % band.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "tests/unit/pdr/attitude/attitude_run.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Sensors `share` times as bad as the configuration says.
/// A walker whose velocity wanders (correlation 1 s, 0.7 m/s each axis) while the board turns;
/// bias, scale and noise of the gyroscope drawn from what the configuration says of them.
class Walk {
 public:
  Walk(const AttitudeErrorConfig& config, unsigned seed, double share = 1.0)
      : random_(seed), config_(config), share_(share) {
    bias_ = draw(share * config.initial_bias_sigma_radps);
    scale_ = Vector3d::Ones() + draw(share * config.initial_scale_sigma);
    offset_ = draw(kGravityMps2 * config.base.sigma_rad);
    magnet_ = draw(share * MagneticOffsetConfig{}.prior_sigma_ut);
    north_ = draw(config.heading_base_sigma_rad);
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
    const double white = share_ * config_.rate_noise_rad_sqrt_s / std::sqrt(kStep);
    imu.stamp_ns = to_ns(t_);
    imu.angular_velocity_radps = rate.cwiseQuotient(scale_) + bias_ +
                                 share_ * config_.turning_error * rate.norm() * turning_ +
                                 draw(white);
    turning_ += -kStep * turning_ + draw(std::sqrt(2.0 * kStep));  // alike for 1 s

    const Vector3d before = velocity_;
    velocity_ += -kStep * velocity_ + draw(share_ * 0.7 * std::sqrt(2.0 * kStep));
    imu.specific_force_mps2 =
        truth.conjugate() * ((velocity_ - before) / kStep + Vector3d(0.0, 0.0, kGravityMps2)) +
        offset_;
    field_error_ += -kStep / 2.0 * field_error_ + draw(std::sqrt(kStep));
    mag.stamp_ns = imu.stamp_ns;
    const Vector3d place = from_euler({0.0, 0.0, north_.z()}) * made::kField + magnet_nearby_ut;
    mag.field_ut = truth.conjugate() * (place + share_ * 1.5 * field_error_) + magnet_;
  }

  static constexpr double kStep = 0.01;
  Vector3d magnet_nearby_ut = Vector3d::Zero();

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
  double share_;
  Vector3d bias_, scale_, offset_, magnet_, north_, turning_, phase_, field_error_, velocity_;
  double t_ = 0.0;
};

/// Mean NEES of walks, and its parts.
struct Nees {
  double total = 0.0;
  double inclination = 0.0;
  double heading = 0.0;

  void add(const AttitudeEstimate& estimate, const Quaterniond& truth, double weight) {
    const Vector3d e = log_rotation(truth * estimate.world_from_body.conjugate());
    const Eigen::Matrix3d& p = estimate.covariance_rad2;
    total += weight * e.dot(p.inverse() * e) / 3.0;
    inclination += weight * e.head<2>().dot(p.topLeftCorner<2, 2>().inverse() * e.head<2>()) / 2.0;
    heading += weight * e.z() * e.z() / p(2, 2);
  }
  void print(const char* name, int walks) const {
    std::printf("NEES of %d %s walks: %.2f, inclination %.2f, heading %.2f\n", walks, name, total,
                inclination, heading);
  }
};

AttitudeConfig honest_sensors() {
  AttitudeConfig config = made::prompt_sensors();
  config.error.timing_sigma_s = 1e-6;
  config.magnetic.delay.least_sigma_s = 1e-6;
  config.error.base.sigma_rad = 0.005;
  return config;
}

constexpr int kWalks = 60;

/// At the end of a minute.
Nees nees_of_walks(double share) {
  const AttitudeConfig config = honest_sensors();
  Nees nees;
  for (unsigned seed = 0; seed < kWalks; ++seed) {
    Walk walk(config.error, seed + 100, share);
    AttitudeFilter filter(config);
    Quaterniond truth;
    for (int i = 0; i < 6000; ++i) {
      ImuSample imu;
      MagSample mag;
      walk.next(imu, mag, truth);
      filter.process(mag);
      filter.process(imu);
    }
    nees.add(filter.estimate(), truth, 1.0 / kWalks);
  }
  return nees;
}

TEST(AttitudeHonesty, NeesOfSimulatedWalksIsInsideItsBand) {
  const Nees nees = nees_of_walks(1.0);
  nees.print("simulated", kWalks);
  // chi^2 of 180 degrees of freedom over 180: 0.80 to 1.22.
  EXPECT_GT(nees.total, 0.80);
  EXPECT_LT(nees.total, 1.22);
}

TEST(AttitudeHonesty, FarBetterSensorsNarrowTheCovariance) {
  // Variances twenty-five times smaller than assumed.
  const Nees nees = nees_of_walks(0.2);
  nees.print("calm", kWalks);
  EXPECT_GT(nees.total, 0.4);
  EXPECT_LT(nees.total, 2.0);
}

TEST(AttitudeHonesty, AMagnetAfterACalmMinuteDoesNotCatchItOverconfident) {
  const AttitudeConfig config = honest_sensors();
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  Nees nees;
  for (unsigned seed = 0; seed < kWalks; ++seed) {
    Walk walk(config.error, seed + 100, 0.2);
    AttitudeFilter filter(config);
    Quaterniond truth;
    const Vector3d magnet(6.0 * normal(random), 6.0 * normal(random), 6.0 * normal(random));
    for (int i = 0; i < 9000; ++i) {
      // For ten seconds of each twenty.
      walk.magnet_nearby_ut = i > 6000 && i % 2000 < 1000 ? magnet : Vector3d::Zero();
      ImuSample imu;
      MagSample mag;
      walk.next(imu, mag, truth);
      filter.process(mag);
      filter.process(imu);
      if (i >= 6000 && i % 100 == 99) nees.add(filter.estimate(), truth, 1.0 / (30.0 * kWalks));
    }
  }
  nees.print("magnetic", kWalks);
  EXPECT_LT(nees.total, 2.0);
}

}  // namespace
}  // namespace vpdr::pdr
