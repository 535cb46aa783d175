#pragma once
// How large a filter's errors are against what its noises say, learned from its own corrections: a
// filter whose noises are as assumed corrects itself, summed up over a while, by as much as its
// covariance shrinks. In a calm laboratory it corrects less, in a building more, and the factor by
// which its variances have to be multiplied follows (the variance of unit weight). The sum is over
// times longer than an error stays alike, so that one which comes and goes does not count many
// times. Nothing is learned while nothing moves. Until something was learned, and again after
// nothing was corrected for a while, the noises hold as they are assumed: the factor is one.
// Not thread-safe; allocates nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct CorrectionScaleConfig {
  double block_s = 6.0;    ///< s, over which corrections are summed up; (0.1, 600)
  double memory_s = 20.0;  ///< s, over which the factor is judged; (0.1, 3600)
  double least = 0.03;     ///< factor, however calm it is; (0, 1]
  double largest = 10.0;   ///< factor of one block, however wild; [1, 1e6)
};

class CorrectionScale {
 public:
  explicit CorrectionScale(const CorrectionScaleConfig& config) : config_(config) {}

  /// A correction of one or two directions, and the sum of the variances that it is expected to
  /// have in them.
  void add(const Eigen::Vector2d& turn_rad, double expected_rad2);
  /// Time goes by in motion.
  void pass(double dt_s);

  /// Of variances.
  [[nodiscard]] double factor() const { return factor_; }

 private:
  CorrectionScaleConfig config_;
  Eigen::Vector2d turn_rad_ = Eigen::Vector2d::Zero();  ///< of this block
  double expected_rad2_ = 0.0;
  double duration_s_ = 0.0;  ///< of it
  double weight_s_ = 0.0;    ///< time that the factor stands for
  double factor_ = 1.0;
};

}  // namespace vpdr::pdr
