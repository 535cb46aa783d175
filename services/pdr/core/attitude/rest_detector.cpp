#include "pdr/core/attitude/rest_detector.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {

/// Fewer samples say nothing about spread.
constexpr int kMinSamples = 3;

double largest_std(const Eigen::Vector3d& sum, const Eigen::Vector3d& squares, int n) {
  const Eigen::Vector3d mean = sum / n;
  const Eigen::Vector3d variance = squares / n - mean.cwiseProduct(mean);
  return std::sqrt(std::max(0.0, variance.maxCoeff()));
}

}  // namespace

RestDetector::RestDetector(const RestConfig& config) : config_(config) {
  config_.blocks = std::clamp(config_.blocks, 2, static_cast<int>(kCapacity));
}

void RestDetector::add(const Eigen::Vector3d& rate_radps, const Eigen::Vector3d& force_mps2,
                       double dt_s) {
  if (samples_ == 0) {
    rate_origin_ = rate_radps;
    force_origin_ = force_mps2;
  }
  const Eigen::Vector3d rate = rate_radps - rate_origin_;
  const Eigen::Vector3d force = force_mps2 - force_origin_;
  rate_sum_ += rate;
  rate_squares_ += rate.cwiseProduct(rate);
  force_sum_ += force;
  force_squares_ += force.cwiseProduct(force);
  elapsed_s_ += dt_s;
  ++samples_;
  if (elapsed_s_ >= config_.block_s && samples_ >= kMinSamples) close_block();
}

void RestDetector::reset() { *this = RestDetector(config_); }

bool RestDetector::take_new_rest_block() {
  const bool taken = new_block_;
  new_block_ = false;
  return taken;
}

void RestDetector::close_block() {
  const bool still = largest_std(rate_sum_, rate_squares_, samples_) < config_.rate_std_radps &&
                     largest_std(force_sum_, force_squares_, samples_) < config_.force_std_mps2;
  const BlockMean mean{rate_origin_ + rate_sum_ / samples_, force_origin_ + force_sum_ / samples_};
  rate_sum_.setZero();
  rate_squares_.setZero();
  force_sum_.setZero();
  force_squares_.setZero();
  elapsed_s_ = 0.0;
  samples_ = 0;
  if (!still) {
    still_count_ = 0;
    at_rest_ = false;
    return;
  }
  judge(mean);
}

void RestDetector::judge(const BlockMean& newest) {
  for (std::size_t i = 0; i < still_count_; ++i) {
    const BlockMean& other = still_[(next_ + kCapacity - 1 - i) % kCapacity];
    const double rate_step = (newest.rate - other.rate).cwiseAbs().maxCoeff();
    const double force_step = (newest.force - other.force).cwiseAbs().maxCoeff();
    if (rate_step > config_.rate_step_radps || force_step > config_.force_step_mps2) {
      still_count_ = i;
      break;
    }
  }
  still_[next_] = newest;
  next_ = (next_ + 1) % kCapacity;
  still_count_ = std::min(still_count_ + 1, static_cast<std::size_t>(config_.blocks));
  mean_rate_.setZero();
  for (std::size_t i = 0; i < still_count_; ++i) {
    mean_rate_ += still_[(next_ + kCapacity - 1 - i) % kCapacity].rate;
  }
  mean_rate_ /= static_cast<double>(still_count_);
  at_rest_ = still_count_ == static_cast<std::size_t>(config_.blocks) &&
             mean_rate_.cwiseAbs().maxCoeff() < config_.largest_bias_radps;
  new_block_ = at_rest_;
}

}  // namespace vpdr::pdr
