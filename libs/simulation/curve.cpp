#include "simulation/curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::simulation {

MonotoneCurve::MonotoneCurve(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0.0) {
  if (x_.size() < 2 || x_.size() != y_.size()) {
    throw std::invalid_argument("MonotoneCurve: needs as many values as knots, at least two");
  }
  for (std::size_t i = 1; i + 1 < x_.size(); ++i) {
    const double before = x_[i] - x_[i - 1];
    const double after = x_[i + 1] - x_[i];
    const double left = (y_[i] - y_[i - 1]) / before;
    const double right = (y_[i + 1] - y_[i]) / after;
    if (left * right <= 0.0) continue;
    // Weighted harmonic mean: never more than three times the smaller slope, so no overshoot.
    const double w_left = 2.0 * after + before;
    const double w_right = after + 2.0 * before;
    slope_[i] = (w_left + w_right) / (w_left / left + w_right / right);
  }
}

double MonotoneCurve::operator()(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  const auto next = std::upper_bound(x_.begin(), x_.end(), x);
  const auto i = static_cast<std::size_t>(next - x_.begin()) - 1;
  const double width = x_[i + 1] - x_[i];
  const double u = (x - x_[i]) / width;
  const double v = 1.0 - u;
  return v * v * (1.0 + 2.0 * u) * y_[i] + u * u * (3.0 - 2.0 * u) * y_[i + 1] +
         width * u * v * (v * slope_[i] - u * slope_[i + 1]);
}

Eigen::Vector3d MotionState::specific_force_mps2() const {
  return world_from_body.conjugate() *
         (acceleration_mps2 + Eigen::Vector3d(0.0, 0.0, kGravityMps2));
}

MotionSpline::MotionSpline(double interval_s, std::vector<Control> controls)
    : interval_s_(interval_s), controls_(std::move(controls)) {
  if (controls_.size() < 4 || !(interval_s > 0.0)) {
    throw std::invalid_argument("MotionSpline: needs four controls and a positive interval");
  }
}

double MotionSpline::duration_s() const {
  return static_cast<double>(controls_.size() - 3) * interval_s_;
}

namespace {

/// Angular velocity in body axes from the rates of the z-y-x angles.
Eigen::Vector3d body_rates(const MotionSpline::Control& value, const MotionSpline::Control& rate) {
  const double sr = std::sin(value[3]), cr = std::cos(value[3]);
  const double sp = std::sin(value[4]), cp = std::cos(value[4]);
  return {rate[3] - rate[5] * sp, rate[4] * cr + rate[5] * cp * sr,
          -rate[4] * sr + rate[5] * cp * cr};
}

}  // namespace

MotionState MotionSpline::at(double t_s) const {
  const double knots = std::clamp(t_s, 0.0, duration_s()) / interval_s_;
  const std::size_t i = std::min(static_cast<std::size_t>(knots), controls_.size() - 4);
  const double u = knots - static_cast<double>(i);
  const double v = 1.0 - u;
  const Control& a = controls_[i];
  const Control& b = controls_[i + 1];
  const Control& c = controls_[i + 2];
  const Control& d = controls_[i + 3];
  const Control value = (v * v * v * a + (3.0 * u * u * u - 6.0 * u * u + 4.0) * b +
                         (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) * c + u * u * u * d) /
                        6.0;
  const Control rate =
      (-v * v * a + (3.0 * u * u - 4.0 * u) * b + (-3.0 * u * u + 2.0 * u + 1.0) * c + u * u * d) /
      (2.0 * interval_s_);
  const Control second =
      (v * a + (3.0 * u - 2.0) * b + (1.0 - 3.0 * u) * c + u * d) / (interval_s_ * interval_s_);
  MotionState state;
  state.position_m = value.head<3>();
  state.velocity_mps = rate.head<3>();
  state.acceleration_mps2 = second.head<3>();
  state.world_from_body = from_euler({value[3], value[4], value[5]});
  state.angular_velocity_radps = body_rates(value, rate);
  return state;
}

}  // namespace vpdr::simulation
