#pragma once
// The two curves everything moves on: a monotone one through given knots (progress and phase of the
// steps) and a smooth 6-DoF one whose derivatives are exact (the truth).
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace vpdr::simulation {

/// Piecewise cubic through knots that neither overshoots nor turns back between them (Fritsch and
/// Butland 1984). Continuous first derivative; constant outside the knots.
class MonotoneCurve {
 public:
  /// `x` strictly increasing, as many as `y`, at least two.
  MonotoneCurve(std::vector<double> x, std::vector<double> y);
  [[nodiscard]] double operator()(double x) const;

 private:
  std::vector<double> x_, y_, slope_;
};

/// Position, attitude and their derivatives at one instant. World ENU, body forward-left-up.
struct MotionState {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_mps2 = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();  ///< body axes

  /// What an ideal accelerometer reads: R^T (a + g), +g on the axis that points up at rest.
  [[nodiscard]] Eigen::Vector3d specific_force_mps2() const;
};

/// A 6-DoF motion: uniform cubic B-splines of x, y, z, roll, pitch and yaw (z-y-x angles, yaw
/// unwrapped, |pitch| well below pi/2). Position and angles are twice continuously differentiable
/// and every derivative below is the exact one of the curve. Thread-safe once made.
class MotionSpline {
 public:
  using Control = Eigen::Matrix<double, 6, 1>;  ///< x y z roll pitch yaw

  /// Control k sits at time (k - 1) * interval_s; the curve is defined on [0, duration_s()].
  MotionSpline(double interval_s, std::vector<Control> controls);

  [[nodiscard]] double duration_s() const;
  /// State at `t_s`, clamped to the curve's domain.
  [[nodiscard]] MotionState at(double t_s) const;

 private:
  double interval_s_;
  std::vector<Control> controls_;
};

}  // namespace vpdr::simulation
