#include "pdr/core/steps/weight_transfer.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {
/// What goes to and fro once a stride is below 1.4 Hz even in runners.
constexpr double kCutoffHz = 2.0;
constexpr int kOrder = 2;
/// A leg carries the body for up to a second and a half in slow walks.
constexpr double kDriftTimeS = 2.0;
/// Time over which the direction the board hangs in follows: a turn, not a lean into it, s.
constexpr double kUpMemoryS = 3.0;
/// The force changes sign amid the time in which both feet carry, s after the second one landed.
constexpr double kHalfDoubleSupportS = 0.05;
/// Steps of these periods teach the axis, s.
constexpr double kShortestStepS = 0.35;
constexpr double kLongestStepS = 0.9;
/// Steps that are remembered, for a board may be put on anew, and the fewest that tell the axis.
constexpr double kMemorySteps = 40.0;
constexpr int kLeastSteps = 3;
/// Correlation of the lateral force with that a step before: as far below zero, or it is none.
constexpr double kClearCorrelation = -0.3;

StepConfig lateral_filter(const StepConfig& config) {
  StepConfig lateral = config;
  lateral.cutoff_hz = kCutoffHz;
  lateral.filter_order = kOrder;
  lateral.drift_time_s = kDriftTimeS;
  return lateral;
}
}  // namespace

WeightTransfer::WeightTransfer(const StepConfig& config)
    : filter_config_(lateral_filter(config)),
      least_mps2_(config.lateral_mps2),
      filters_{DriftFreeLowPass(filter_config_), DriftFreeLowPass(filter_config_),
               DriftFreeLowPass(filter_config_)} {}

void WeightTransfer::restart() {
  filters_.fill(DriftFreeLowPass(filter_config_));
  count_ = 0;
  side_ = 0;
  lateral_mps2_ = 0.0;
}

std::optional<TimestampNs> WeightTransfer::add(const SignalValue& value) {
  Eigen::Vector3d force;
  for (int i = 0; i < 3; ++i) {
    force[i] = filters_[static_cast<std::size_t>(i)].filter(value.force_mps2[i]);
  }
  up_ += std::min(1.0, StepSignal::kPeriodS / kUpMemoryS) * (value.up - up_);
  history_[next_] = force;
  next_ = (next_ + 1) % kHistory;
  count_ = std::min(count_ + 1, kHistory);
  const TimestampNs before_ns = stamp_ns_;
  const double before_mps2 = lateral_mps2_;
  stamp_ns_ = value.stamp_ns - to_ns(filters_[0].delay_s());
  if (!axis_) return std::nullopt;
  lateral_mps2_ = axis_->dot(force);
  if (lateral_mps2_ * before_mps2 <= 0.0) {
    const double way = std::abs(lateral_mps2_) + std::abs(before_mps2);
    const double share = way > 0.0 ? std::abs(before_mps2) / way : 1.0;
    crossing_ns_ = before_ns + to_ns(share * to_seconds(stamp_ns_ - before_ns));
  }
  if (std::abs(lateral_mps2_) < least_mps2_) return std::nullopt;
  one_leg_until_ns_ = stamp_ns_;
  const int before = side_;
  side_ = lateral_mps2_ > 0.0 ? 1 : -1;
  return before == -side_ ? std::optional(crossing_ns_ - to_ns(kHalfDoubleSupportS)) : std::nullopt;
}

void WeightTransfer::learn(double step_s) {
  if (step_s < kShortestStepS || step_s > kLongestStepS) return;
  const auto lag = static_cast<std::size_t>(std::lround(step_s * StepSignal::kRateHz));
  if (count_ < 2 * lag) return;
  const double kept = 1.0 - 1.0 / kMemorySteps;
  repeated_ *= kept;
  energy_ *= kept;
  steps_ = std::min(steps_ + 1, kLeastSteps);
  for (std::size_t age = 0; age < lag; ++age) {
    const Eigen::Vector3d& now = history(age);
    const Eigen::Vector3d& before = history(age + lag);
    repeated_ += 0.5 * (now * before.transpose() + before * now.transpose());
    energy_ += 0.5 * (now * now.transpose() + before * before.transpose());
  }
  find_axis();
}

/// Along the lateral axis the products are the most negative.
void WeightTransfer::find_axis() {
  if (steps_ < kLeastSteps) return;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  const Eigen::Vector3d up = up_.normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - up * up.transpose();
  solver.computeDirect(across * repeated_ * across);
  const Eigen::Vector3d found = solver.eigenvectors().col(0);
  const double energy = found.dot(energy_ * found);
  if (solver.eigenvalues()[0] > kClearCorrelation * energy || energy <= 0.0) {
    axis_.reset();
    side_ = 0;
    return;
  }
  axis_ = axis_ && axis_->dot(found) < 0.0 ? Eigen::Vector3d(-found) : found;
}

}  // namespace vpdr::pdr
