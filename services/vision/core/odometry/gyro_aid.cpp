#include "vision/core/odometry/gyro_aid.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {

GyroAid::GyroAid(const GyroAidConfig& config)
    : config_(config),
      variance_(Eigen::Vector3d::Constant(config.bias_sigma_radps * config.bias_sigma_radps)) {}

GyroAid::Turn GyroAid::corrected(const Eigen::Quaterniond& measured, double dt_s) const {
  Turn turn;
  turn.rotation = (measured * exp_rotation(-bias_ * dt_s)).normalized();
  turn.sigma_rad = std::hypot(config_.noise_rad, std::sqrt(variance_.maxCoeff()) * dt_s);
  return turn;
}

// The turn's error is noise minus dt times the bias' error; the posterior of the turn is carried
// over to the bias as a smoother does (Rauch, Tung and Striebel 1965), axis by axis.
void GyroAid::learn(const Turn& turn, double dt_s, const Eigen::Vector3d& correction_rad,
                    const Eigen::Matrix3d& posterior_rad2) {
  const double before = turn.sigma_rad * turn.sigma_rad;
  for (int axis = 0; axis < 3; ++axis) {
    const double gain = -variance_(axis) * dt_s / before;
    bias_(axis) += gain * correction_rad(axis);
    const double learnt = std::max(0.0, before - posterior_rad2(axis, axis));
    variance_(axis) -= std::min(0.99 * variance_(axis), gain * gain * learnt);
    variance_(axis) += config_.bias_walk_radps2 * config_.bias_walk_radps2 * dt_s;
    variance_(axis) =
        std::min(variance_(axis), config_.bias_sigma_radps * config_.bias_sigma_radps);
  }
}

}  // namespace vpdr::vision
