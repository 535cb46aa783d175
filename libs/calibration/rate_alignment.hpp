#pragma once
// How a gyroscope's axes lie to those of a sensor that sees a fixed direction (gravity, the
// magnetic field): while the board turns by the small angle t, the direction d it sees changes by
//
//   d1 - d0 = -(G t) x (d0 + d1) / 2,
//
// linear in the matrix G from gyroscope to direction axes. G is a rotation where both are right-
// handed and in scale; a flipped gyroscope axis makes its determinant negative. Both signs of the
// direction give the same G. Accumulates the normal equations: allocates nothing, pure, for one
// thread.
#include <Eigen/Core>
#include <optional>

namespace vpdr::calibration {

class RateAlignment {
 public:
  /// One turn: `turn_rad` is the integral of the gyroscope's rates (bias taken off), `before` and
  /// `after` the directions (unit length), `sigma` the deviation expected of
  /// their difference.
  void add(const Eigen::Vector3d& turn_rad, const Eigen::Vector3d& before,
           const Eigen::Vector3d& after, double sigma);

  /// G, and how well it is known.
  struct Solution {
    Eigen::Matrix3d direction_from_gyro = Eigen::Matrix3d::Identity();
    double misfit = 0.0;       ///< size of the turns' errors, in the sigmas given with them
    double worst_sigma = 0.0;  ///< by the misfit, of the combination of elements known least
  };
  /// nullopt: the turns so far were about too few axes.
  [[nodiscard]] std::optional<Solution> solve() const;

  [[nodiscard]] std::size_t turns() const { return turns_; }

 private:
  Eigen::Matrix<double, 9, 9> normal_ = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right_ = Eigen::Matrix<double, 9, 1>::Zero();
  double squares_ = 0.0;
  std::size_t turns_ = 0;
};

}  // namespace vpdr::calibration
