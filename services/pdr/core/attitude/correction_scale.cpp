#include "pdr/core/attitude/correction_scale.hpp"

#include <algorithm>

namespace vpdr::pdr {

void CorrectionScale::add(const Eigen::Vector2d& turn_rad, double expected_rad2) {
  turn_rad_ += turn_rad;
  expected_rad2_ += expected_rad2;
}

void CorrectionScale::pass(double dt_s) {
  duration_s_ += dt_s;
  if (duration_s_ < config_.block_s) return;
  double seen = 1.0;
  if (expected_rad2_ > 0.0) {
    seen = std::min(turn_rad_.squaredNorm() / expected_rad2_, config_.largest);
  }
  // What is assumed stands for one block.
  weight_s_ = std::min(std::max(weight_s_, config_.block_s) + duration_s_, config_.memory_s);
  factor_ += std::min(1.0, duration_s_ / weight_s_) * (seen - factor_);
  factor_ = std::max(factor_, config_.least);
  turn_rad_.setZero();
  expected_rad2_ = 0.0;
  duration_s_ = 0.0;
}

}  // namespace vpdr::pdr
