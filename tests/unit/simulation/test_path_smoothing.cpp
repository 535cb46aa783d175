#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "simulation/curve.hpp"
#include "simulation/path_smoothing.hpp"
#include "simulation/random.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

constexpr TimestampNs kStart = 7 * kNsPerSecond;

/// Ten seconds of a hand that waves, with exact rates.
class SmoothedPath : public testing::Test {
 protected:
  SmoothedPath() : motion_(0.02, controls()) {
    Random random(1, "imu");
    for (int k = 0; k <= 2000; ++k) {  // 200 Hz, biased
      const MotionState state = motion_.at(k * 0.005);
      ImuSample sample;
      sample.stamp_ns = kStart + k * 5'000'000LL;
      sample.angular_velocity_radps =
          state.angular_velocity_radps + Vector3d(0.001, -0.001, 0.0005);
      sample.specific_force_mps2 = state.specific_force_mps2();
      imu_.push_back(sample);
    }
  }

  static std::vector<MotionSpline::Control> controls() {
    std::vector<MotionSpline::Control> controls;
    for (int k = 0; k < 510; ++k) {
      const double t = 0.02 * k;
      MotionSpline::Control c;
      c << 0.3 * std::sin(2.0 * t), 0.2 * std::sin(3.0 * t), 1.3 + 0.1 * std::sin(5.0 * t),
          0.3 * std::sin(4.0 * t), 0.2 * std::sin(5.0 * t), 0.8 * std::sin(1.5 * t);
      controls.push_back(c);
    }
    return controls;
  }

  /// Poses at 120 Hz with noise; runs of eight in two hundred are mistaken by degrees and
  /// centimetres.
  std::vector<PathPose> reference(double rad, double metres, bool with_mistakes) const {
    Random random(2, "reference");
    std::vector<PathPose> poses;
    for (int k = 1; k < 1190; ++k) {
      const TimestampNs since = k * 8'333'333LL;
      const MotionState state = motion_.at(to_seconds(since));
      const bool mistaken = with_mistakes && k % 200 >= 50 && k % 200 < 58;
      const auto noise = [&](double sigma) {
        return Vector3d(random.normal(sigma), random.normal(sigma), random.normal(sigma));
      };
      const Vector3d off = mistaken ? Vector3d(0.03, -0.02, 0.04) : Vector3d::Zero();
      poses.push_back({kStart + since, state.position_m + noise(metres) + off,
                       exp_rotation(noise(rad) + off) * state.world_from_body});
    }
    return poses;
  }

  /// Root mean square error of turns over 50 ms, degrees, and of positions, metres.
  struct Errors {
    double turn_deg, position_m;
  };
  Errors errors(const ReferencePath& path) const {
    double turn = 0.0, place = 0.0;
    int count = 0;
    for (double t = 0.5; t < 9.4; t += 0.05, ++count) {
      const TimestampNs at = kStart + to_ns(t);
      const auto truth = motion_.at(t), later = motion_.at(t + 0.05);
      const Eigen::Quaterniond seen(path.at(at).linear().transpose() *
                                    path.at(at + 50'000'000).linear());
      const double off = log_rotation((seen.conjugate() *
                                       (truth.world_from_body.conjugate() * later.world_from_body))
                                          .normalized())
                             .norm();
      turn += off * off;
      place += (path.at(at).translation() - truth.position_m).squaredNorm();
    }
    return {to_degrees(std::sqrt(turn / count)), std::sqrt(place / count)};
  }

  MotionSpline motion_;
  std::vector<ImuSample> imu_;
};

TEST_F(SmoothedPath, LosesTheReferencesNoiseAndMistakes) {
  const ReferencePath raw(reference(0.0015, 0.001, true));
  const Errors before = errors(raw), after = errors(smooth_with_gyroscope(raw, imu_));
  EXPECT_GT(before.turn_deg, 0.2);
  EXPECT_LT(after.turn_deg, 0.03);
  EXPECT_LT(after.position_m, 0.6 * before.position_m);
}

TEST_F(SmoothedPath, KeepsAPerfectReference) {
  const Errors after =
      errors(smooth_with_gyroscope(ReferencePath(reference(0.0, 0.0, false)), imu_));
  EXPECT_LT(after.turn_deg, 0.01);
  EXPECT_LT(after.position_m, 2e-4);
}

TEST_F(SmoothedPath, StaysAsItIsWithoutAGyroscope) {
  const ReferencePath raw(reference(0.0015, 0.001, true));
  EXPECT_EQ(smooth_with_gyroscope(raw, {}).at(kStart + kNsPerSecond).matrix(),
            raw.at(kStart + kNsPerSecond).matrix());
  for (ImuSample& sample : imu_) sample.has_angular_velocity = false;
  EXPECT_EQ(smooth_with_gyroscope(raw, imu_).at(kStart + kNsPerSecond).matrix(),
            raw.at(kStart + kNsPerSecond).matrix());
}

}  // namespace
}  // namespace vpdr::simulation
