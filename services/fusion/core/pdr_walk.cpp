#include "fusion/core/pdr_walk.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vpdr::fusion {
namespace {

/// Of a position that nothing makes unsure, m^2.
constexpr double kLeastVarianceM2 = 0.01;
/// Deviations by which the filter without vision errs at most.
constexpr double kLargestBend = 4.0;
/// Who is back at the origin from further away started again; from nearer, the steps that pdr
/// thought a walk begins with were none.
constexpr double kFirstStepsM = 5.0;

}  // namespace

/// As if scale and bias were known.
Eigen::Matrix2d bent_variance_m2(const FilterState& state) {
  StateMatrix p = state.p;
  for (const StateIndex known : {kScale, kBias}) {
    const StateVector column = p.col(known);
    if (column[known] > 0.0) p.noalias() -= column * (column.transpose() / column[known]);
  }
  return p.block<2, 2>(kX, kX);
}

Eigen::Vector2d news_in(const Eigen::Vector2d& bend_m, const Eigen::Matrix2d& with_m2,
                        const Eigen::Matrix2d& without_m2) {
  const Eigen::Matrix2d least = kLeastVarianceM2 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d weighed = (without_m2 + least).inverse() * bend_m;
  const double deviations = std::sqrt(std::max(bend_m.dot(weighed), 0.0));
  const double kept = deviations > kLargestBend ? kLargestBend / deviations : 1.0;
  return kept * (with_m2 + least) * weighed;
}

void PdrWalk::take(TimestampNs stamp_ns, const Eigen::Vector2d& position_m) {
  const Place place{stamp_ns, position_m};
  if (!earliest_ || stamp_ns < earliest_->stamp_ns) earliest_ = place;
  if (newest_ && stamp_ns <= newest_->stamp_ns) return;
  if (newest_ && position_m.isZero(0.0) && newest_->position_m.norm() > kFirstStepsM) {
    before_restart_m_ += newest_->position_m;
  }
  newest_ = place;
}

Eigen::Vector2d PdrWalk::position_m() const {
  if (!newest_) return Eigen::Vector2d::Zero();
  return before_restart_m_ + newest_->position_m - earliest_->position_m;
}

}  // namespace vpdr::fusion
