#include "pdr/core/heading/carried_axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rotation.hpp"
#include "pdr/core/heading/walking_heading.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFast_s = 0.5;
constexpr double kSlow_s = 1.0;
/// How slowly the usual tilt follows a walk.
constexpr double kUsual_s = 20.0;
constexpr double kSpacing_s = 0.25;
/// A forward axis that rises or falls more steeply tells no heading: the sine of 60 degrees.
constexpr double kSteep = 0.87;
/// Limbs swing a device beyond that tilt, but not so far.
constexpr double kFar = 1.5;
/// Short of the tilt that counts as another way of carrying, it is the old one again.
constexpr double kBack = 0.75;
/// Steady: the two averages of the tilt agree so far, and the trial's with where it began, rad.
constexpr double kAgreeing = 0.25;
constexpr double kMoved = 0.5;
constexpr double kTrial_s = 1.0;
/// Nobody moves it for longer: a limb that swings so far carries it, s.
constexpr double kLongest_s = 5.0;
/// An axis this level that lies so near to the direction held still tells it, rad.
constexpr double kLevel = 0.7;
constexpr double kNear = 0.6;
/// Whoever stands longer than this may have turned, s.
constexpr double kHalt_s = 2.0;

double angle(const Vector3d& a, const Vector3d& b) {
  const double size = a.norm() * b.norm();
  return size > 0.0 ? std::acos(std::clamp(a.dot(b) / size, -1.0, 1.0)) : kPi;
}

double yaw(const Vector2d& heading) { return std::atan2(heading.y(), heading.x()); }

bool is_near(const Vector2d& a, const Vector2d& b) {
  return std::abs(wrap_pi(yaw(a) - yaw(b))) < kNear;
}

Quaterniond upright(const Vector3d& up) {
  return Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up);
}

}  // namespace

CarriedAxis::CarriedAxis(double turned_over_rad, Carry carry)
    : turned_over_(turned_over_rad), carry_(carry) {}

void CarriedAxis::add(TimestampNs stamp_ns, const Quaterniond& frame_from_body, bool walking) {
  const double passed_s = std::max(to_seconds(stamp_ns - last_ns_), 0.0);
  const double dt_s = std::min(passed_s, kSpacing_s);
  last_ns_ = stamp_ns;
  if (on_trunk(carry_)) {
    heading_ = forward_heading(frame_from_body);
    return;
  }
  const Vector3d up = frame_from_body.conjugate() * Vector3d::UnitZ();
  if (!started_) begin(up);
  average(up, dt_s);
  stood_s_ = walking ? 0.0 : stood_s_ + passed_s;
  if (passed_s > kHalt_s) {
    resume(up);
  } else if (state_ != State::kSteady) {
    try_out(frame_from_body, dt_s);
  } else if (walking) {
    walk(dt_s);
  } else if (stood_s_ > kHalt_s) {
    stand();
  }
  follow(up, frame_from_body);
  if (state_ == State::kSteady) remember(dt_s);
}

/// The averages hear of a movement later than it begins.
void CarriedAxis::follow(const Vector3d& up, const Quaterniond& frame_from_body) {
  heading_ = forward_heading(frame_from_body * axis_.body_from_axis);
  const bool steady = state_ == State::kSteady;
  if (steady && (!walks_ || angle(up, axis_.up) < kFar * turned_over_)) return;
  const Vector2d usual = steady ? before() : held_;
  if (heading_.norm() < kLevel || !is_near(heading_, usual)) heading_ = usual;
}

CarriedAxis::News CarriedAxis::take_news() {
  if (started_ && !walks_ && state_ == State::kSteady) set_off();
  return std::exchange(news_, News::kNone);
}

void CarriedAxis::take_up(const Vector3d& up) {
  const bool is_forward = carry_ != Carry::kPocket && std::abs(up.x()) < kSteep * up.norm();
  axis_ = {is_forward ? Quaterniond::Identity() : upright(up), up, is_forward};
  is_new_ = true;
}

void CarriedAxis::begin(const Vector3d& up) {
  started_ = true;
  fast_up_ = slow_up_ = up;
  take_up(up);
  past_.fill(Vector2d::UnitX());
}

/// In a silence anything may happen to it, as while one stands.
void CarriedAxis::resume(const Vector3d& up) {
  fast_up_ = slow_up_ = up;
  state_ = State::kSteady;
  stand();
}

void CarriedAxis::average(const Vector3d& up, double dt_s) {
  fast_up_ += std::min(1.0, dt_s / kFast_s) * (up - fast_up_);
  slow_up_ += std::min(1.0, dt_s / kSlow_s) * (up - slow_up_);
}

bool CarriedAxis::hangs_as(const Axis& axis, double share) const {
  return angle(fast_up_, axis.up) < share * turned_over_;
}

/// Whoever sits down has the device in the same pocket again on getting up.
void CarriedAxis::stand() {
  walks_ = false;
  if (has_walked_ && hangs_as(walked_with_)) {
    axis_ = walked_with_;
    is_new_ = false;
  } else if (!hangs_as(axis_) && angle(fast_up_, slow_up_) < kAgreeing) {
    take_up(fast_up_);
  }
}

void CarriedAxis::set_off() {
  walks_ = true;
  if (!hangs_as(axis_)) take_up(fast_up_);
  if (is_new_) news_ = News::kAnew;
  is_new_ = false;
  walked_with_ = axis_;
  has_walked_ = true;
}

void CarriedAxis::walk(double dt_s) {
  if (!walks_) return set_off();
  if (!hangs_as(axis_)) return hold();
  axis_.up += dt_s / kUsual_s * (fast_up_ - axis_.up);
  walked_with_ = axis_;
}

void CarriedAxis::hold() {
  state_ = State::kMoving;
  moved_s_ = 0.0;
  held_ = before();
}

void CarriedAxis::try_out(const Quaterniond& frame_from_body, double dt_s) {
  if (hangs_as(axis_, kBack)) {
    state_ = State::kSteady;
    return;
  }
  moved_s_ += dt_s;
  const bool swings = moved_s_ > kLongest_s;
  if (state_ == State::kMoving) {
    if (!swings && angle(fast_up_, slow_up_) > kAgreeing) return;
    state_ = State::kTrying;
    trial_ = {};
    trial_.axis = {upright(slow_up_), slow_up_, false};
  }
  if (!swings && angle(fast_up_, trial_.axis.up) > kMoved) {
    state_ = State::kMoving;
    return;
  }
  trial_.heading += dt_s * forward_heading(frame_from_body * trial_.axis.body_from_axis);
  trial_.old_heading += dt_s * forward_heading(frame_from_body * axis_.body_from_axis);
  trial_.duration_s += dt_s;
  if (trial_.duration_s >= kTrial_s) settle();
}

void CarriedAxis::settle() {
  state_ = State::kSteady;
  if (trial_.old_heading.norm() > kLevel * trial_.duration_s &&
      is_near(trial_.old_heading, held_)) {
    axis_.up = trial_.axis.up;
  } else {
    axis_ = trial_.axis;
    axis_.body_from_axis *=
        Quaterniond(Eigen::AngleAxisd(yaw(held_) - yaw(trial_.heading), Vector3d::UnitZ()));
    news_ = News::kCarriedOn;
  }
  walked_with_ = axis_;
}

/// Over a second, which is a stride or two of a limb that swings, but for the latest half a second,
/// in which the device may have been on its way.
Vector2d CarriedAxis::before() const {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 0; i < kPast - 2; ++i) sum += past_[i];
  return sum.normalized();
}

void CarriedAxis::remember(double dt_s) {
  sum_ += dt_s * heading_;
  sum_s_ += dt_s;
  if (sum_s_ < kSpacing_s) return;
  std::shift_left(past_.begin(), past_.end(), 1);
  past_.back() = sum_ / sum_s_;
  sum_.setZero();
  sum_s_ = 0.0;
}

}  // namespace vpdr::pdr
