#pragma once
// pdr's walk as fusion follows it.
//
// pdr learns late: that its north was wrong, that the gyroscope was biased. Then it moves what was
// walked before, whereas of all that fusion hears from it by headings and steps only the turn of
// the walk as a whole can be told (`yaw_revision`). The rest shows in pdr's position: it is off by
// a `bend` from the walk that fusion's own filter makes of the same headings and steps.
//
// The filter without vision errs by e_i of covariance C, the one with vision by e_f of covariance
// P. The latter knows all that the former does, so that E[e_f e_i'] = P, and e_f = P C^-1 e_i +
// what has nothing to do with e_i. A bend tells e_i; P C^-1 of it is news to the filter with
// vision: all of it where vision told nothing, and little where it told already what pdr learned.
// The errors that pdr never learns, of step length and of how the board is worn, are left out of
// both.
//
// Metres. Allocates nothing, throws nothing.
#include <Eigen/Core>
#include <optional>

#include "core/time.hpp"
#include "fusion/core/filter_state.hpp"

namespace vpdr::fusion {

/// Covariance of the position's error but for what pdr never learns.
[[nodiscard]] Eigen::Matrix2d bent_variance_m2(const FilterState& state);

/// What a bend is worth to the filter with vision: its share in it, of a bend that is not longer
/// than the filter without vision can err.
[[nodiscard]] Eigen::Vector2d news_in(const Eigen::Vector2d& bend_m, const Eigen::Matrix2d& with_m2,
                                      const Eigen::Matrix2d& without_m2);

/// pdr's position since fusion heard of it first. A pdr that starts again is at its origin again;
/// here it goes on from where it was.
class PdrWalk {
 public:
  /// One of pdr's positions; those between the earliest and the newest so far tell nothing.
  void take(TimestampNs stamp_ns, const Eigen::Vector2d& position_m);
  [[nodiscard]] Eigen::Vector2d position_m() const;

 private:
  struct Place {
    TimestampNs stamp_ns;
    Eigen::Vector2d position_m;
  };

  std::optional<Place> earliest_;  ///< this and the newest as pdr has them
  std::optional<Place> newest_;
  Eigen::Vector2d before_restart_m_ = Eigen::Vector2d::Zero();
};

}  // namespace vpdr::fusion
