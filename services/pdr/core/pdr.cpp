#include "pdr/core/pdr.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/last_step.hpp"
#include "core/rotation.hpp"
#include "core/square.hpp"

namespace vpdr::pdr {

namespace {

/// A forward axis steeper than this has no heading: the cosine of its slope.
constexpr double kClearHeading = 0.3;

/// The last word on a step that was announced.
StepEvent withdrawn(const std::optional<StepEvent>& announced, TimestampNs stamp_ns) {
  StepEvent event = announced.value_or(StepEvent{});
  event.stamp_ns = stamp_ns;
  event.status = StepStatus::kWithdrawn;
  event.probability = 0.0;
  return event;
}

}  // namespace

Pdr::Pdr(const PdrConfig& config)
    : config_(config),
      imu_gate_(config.limits),
      mag_gate_(config.limits),
      pressure_gate_(config.limits),
      attitude_(config.attitude),
      relative_(config.attitude),
      field_(config.field.period_s, config.attitude.gap_s),
      steps_(config.step, config.carry),
      step_length_(config.step_length, config.person.height_m, config.carry),
      axis_(config.heading.turned_over_rad, config.carry),
      forward_(config.forward, config.carry),
      straight_(config.straight),
      dead_reckoning_(worn_at(config.dead_reckoning, config.carry), config.field,
                      config.attitude.magnetic.declination_rad),
      height_(config.height) {}

Refusal Pdr::process(const ImuSample& sample, PdrOutput& output) {
  output = PdrOutput{};
  const Refusal refusal = imu_gate_.check(sample);
  if (refusal != Refusal::kNone) return refusal;

  expect_velocity(sample.stamp_ns);
  attitude_.process(sample);
  follow_heading(sample);
  steps_.add(sample.stamp_ns, sample.specific_force_mps2, sample.angular_velocity_radps);
  if (const auto detected = steps_.take()) output.step = take_step(*detected);
  if (heading_is_due(sample.stamp_ns) || output.step) output.heading = heading_at(sample.stamp_ns);
  output.attitude = attitude_.estimate();
  output.odometry = odometry(sample.stamp_ns);
  return Refusal::kNone;
}

void Pdr::learn_from_distance(double distance_m) {
  if (sequence_.empty() || on_stairs() > 0.0) return;
  step_length_.learn_from_distance(distance_m, sequence_.last_shape());
}

Refusal Pdr::process(const MagSample& sample) {
  const Refusal refusal = mag_gate_.check(sample);
  if (refusal != Refusal::kNone) return refusal;
  attitude_.process(sample);
  if (config_.attitude.use_magnetometer) field_.add(sample);
  return Refusal::kNone;
}

Refusal Pdr::process(const PressureSample& sample) {
  const Refusal refusal = pressure_gate_.check(sample);
  if (refusal != Refusal::kNone) return refusal;
  // The start is the origin: until now the walker may have strayed up or down on the way.
  const double strayed = config_.dead_reckoning.height_drift * dead_reckoning_.path_length_m();
  height_.add(sample, steps_.walking(), strayed * strayed);
  return Refusal::kNone;
}

void Pdr::expect_field(double strength_ut, double dip_rad) {
  if (!(strength_ut > 0.0)) return;
  const KnownField field = known_field(strength_ut, dip_rad);
  attitude_.expect(field);
  dead_reckoning_.expect(field);
}

/// Whoever sets off, turns or stops changes velocity, which a horizon held by "small velocities"
/// takes for a tilt.
void Pdr::expect_velocity(TimestampNs stamp_ns) {
  const double speed = sequence_.speed_mps(stamp_ns);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  if (speed > 0.0 && dead_reckoning_.knows_forward()) {
    const Eigen::Vector2d& heading = axis_.heading();
    const double yaw = std::atan2(heading.y(), heading.x()) + dead_reckoning_.forward_rad();
    if (heading.norm() > kClearHeading) {
      velocity = relative_.odom_from_body().conjugate() *
                 Eigen::Vector3d(speed * std::cos(yaw), speed * std::sin(yaw), 0.0);
    }
  }
  attitude_.expect_velocity(velocity);
  relative_.expect_velocity(velocity);
}

void Pdr::follow_heading(const ImuSample& sample) {
  relative_.process(sample);
  const Eigen::Quaterniond& attitude = relative_.odom_from_body();
  axis_.add(sample.stamp_ns, attitude, steps_.walking());
  heading_.add(sample.stamp_ns, axis_.heading());
  forward_.add(sample.stamp_ns, attitude, axis_.heading(), sample.specific_force_mps2);
  field_.advance(sample.stamp_ns, relative_.odom_from_body(), relative_.rate_radps(),
                 attitude_.magnetic().delay_s());
  const RelativeMotion motion = relative_.take_motion();
  dead_reckoning_.pass(motion);
  // The step detector has not heard of the gap yet.
  if (motion.gap_s > 0.0 && steps_.walking()) {
    const double steps = motion.gap_s * sequence_.last().frequency_hz + 0.5;
    dead_reckoning_.stray(steps * sequence_.last_length_m());
  }
  if (const auto field = field_.take(); field && steady_start_.has_settled(*field)) {
    dead_reckoning_.suspect_iron(attitude_.magnetic().offset().prior_ut2());
    dead_reckoning_.take(*field);
  }
}

StepEvent Pdr::take_step(const DetectedStep& detected) {
  const std::optional<StepEvent> announced = tentative_.take(detected.stamp_ns);
  if (detected.status == StepStatus::kWithdrawn) {
    sequence_.withdraw();
    return withdrawn(announced, detected.stamp_ns);
  }
  const WalkingHeading::Mean direction = heading_.mean(detected.previous_ns, detected.stamp_ns);
  StepShape shape = sequence_.shape(detected, direction.yaw_rad);
  shape.on_stairs = on_stairs();
  const StepLength length = step_length_.length(shape);
  if (detected.status == StepStatus::kConfirmed) follow_halt(detected.stamp_ns);
  sequence_.take(detected, shape, direction.yaw_rad, length.length_m);
  DeadReckonedStep step;
  step.length_m = length.length_m;
  step.relative_yaw_rad = direction.yaw_rad;
  step.scale_sigma = length.scale_sigma;
  step.length_noise_m = length.noise_m;
  step.heading_noise_rad =
      std::hypot(sway_sigma_rad(config_.heading, config_.carry), direction.unclear_sigma_rad());
  if (detected.status == StepStatus::kConfirmed) follow_carry();
  StepEvent event = event_of(detected, step);
  event.length_sigma_m = length.sigma_m;
  if (detected.status == StepStatus::kTentative) {
    tentative_.add(event);
    return event;
  }
  event.index = ++step_count_;
  height_.add_step();
  dead_reckoning_.add(step);
  follow_forward(detected);
  follow_corridors(direction.yaw_rad + dead_reckoning_.walking_offset_rad());
  return event;
}

StepEvent Pdr::event_of(const DetectedStep& detected, const DeadReckonedStep& step) const {
  StepEvent event;
  event.stamp_ns = detected.stamp_ns;
  event.index = step_count_ + static_cast<std::uint32_t>(tentative_.size()) + 1;
  event.length_m = step.length_m;
  event.frequency_hz = detected.frequency_hz;
  event.yaw_rad = wrap_pi(step.relative_yaw_rad + dead_reckoning_.walking_offset_rad());
  const double common = std::sqrt(dead_reckoning_.walking_variance_rad2());
  event.yaw_sigma_rad = std::min(std::hypot(common, step.heading_noise_rad), kPi);
  event.yaw_revision_rad = dead_reckoning_.revision_rad();
  event.status = detected.status;
  event.probability = detected.probability;
  return event;
}

/// The walk before this step ended short of where its last step led.
void Pdr::follow_halt(TimestampNs stamp_ns) {
  if (sequence_.empty()) return;
  const double since = to_seconds(stamp_ns - sequence_.last().stamp_ns);
  if (!has_halted(since, 1.0 / sequence_.last().frequency_hz)) return;
  DeadReckonedStep back;
  back.length_m = -kHaltShare * sequence_.last_length_m();
  back.relative_yaw_rad = sequence_.last_yaw_rad();
  back.length_noise_m = kHaltSigma * sequence_.last_length_m();
  dead_reckoning_.add(back);
}

void Pdr::follow_carry() {
  switch (axis_.take_news()) {
    case CarriedAxis::News::kNone:
      return;
    case CarriedAxis::News::kCarriedOn:
      dead_reckoning_.carried_on(square(config_.heading.carried_on_sigma_rad));
      forward_.carried_on(config_.heading.carried_on_sigma_rad);
      return;
    case CarriedAxis::News::kAnew:
      dead_reckoning_.carried_anew(axis_.is_forward_axis()
                                       ? config_.dead_reckoning.forward_sigma_rad
                                       : config_.dead_reckoning.pocket_sigma_rad);
      forward_.carried_anew(axis_.is_forward_axis());
      straight_.forget();
  }
}

void Pdr::follow_forward(const DetectedStep& detected) {
  const std::optional<FoundOffset> found = forward_.take(detected);
  const double before = dead_reckoning_.walking_offset_rad();
  if (found) dead_reckoning_.find_forward(found->offset_rad, found->variance_rad2);
  if (dead_reckoning_.walking_offset_rad() != before) straight_.forget();
}

/// Corridors hold the heading whether a magnetometer tells it or not; where it is found, yaw has
/// another zero and they begin anew.
void Pdr::follow_corridors(double walking_yaw_rad) {
  if (!config_.straight.use) return;
  const bool is_absolute = dead_reckoning_.yaw_is_absolute();
  if (std::exchange(straight_is_absolute_, is_absolute) != is_absolute) straight_.forget();
  if (const auto stretch = straight_.take(walking_yaw_rad)) dead_reckoning_.take(*stretch);
}

bool Pdr::heading_is_due(TimestampNs stamp_ns) {
  const TimestampNs period = to_ns(config_.heading.period_s);
  const bool on_schedule =
      next_heading_ && std::abs(to_seconds(stamp_ns - *next_heading_)) < config_.heading.period_s;
  if (on_schedule && stamp_ns < *next_heading_) return false;
  next_heading_ = (on_schedule ? *next_heading_ : stamp_ns) + period;
  return true;
}

/// A climb counts from even odds on, and wholly from 80 % on: a little doubt, which never ends,
/// shortens no level step and lengthens none of the stairs'.
double Pdr::on_stairs() const { return std::clamp((height_.climbing() - 0.5) / 0.3, 0.0, 1.0); }

}  // namespace vpdr::pdr
