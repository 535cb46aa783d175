#include "fusion/core/fusion.hpp"

#include <algorithm>
#include <cmath>

#include "core/last_step.hpp"
#include "core/rotation.hpp"

namespace vpdr::fusion {
namespace {

bool is_newer(TimestampNs stamp_ns, const std::optional<TimestampNs>& newest_ns) {
  return !newest_ns || stamp_ns > *newest_ns;
}

bool is_finite(const PoseEstimate& pose) {
  return pose.position_m.allFinite() && pose.world_from_body.coeffs().allFinite() &&
         pose.covariance.allFinite() && pose.angular_velocity_radps.allFinite() &&
         std::isfinite(pose.speed_mps);
}

}  // namespace

Fusion::Fusion(const FusionConfig& config) : config_(config), history_(config), inertial_(config) {}

Refusal Fusion::process(const PoseEstimate& pdr_odometry) {
  if (!is_finite(pdr_odometry)) return count(Input::kOdometry, Refusal::kNonFinite);
  note_pdr(pdr_odometry.stamp_ns);
  if (odometry_ && pdr_odometry.stamp_ns == odometry_->stamp_ns) {
    return count(Input::kOdometry, Refusal::kDuplicate);
  }
  pdr_walk_.take(pdr_odometry.stamp_ns, pdr_odometry.position_m.head<2>());
  if (!odometry_ || pdr_odometry.stamp_ns > odometry_->stamp_ns) odometry_ = pdr_odometry;
  return count(Input::kOdometry, Refusal::kNone);
}

Refusal Fusion::process(const HeadingEstimate& heading) {
  const Refusal verdict = insert(heading);
  if (verdict == Refusal::kNone) note_pdr(heading.stamp_ns);
  return count(Input::kHeading, verdict);
}

Refusal Fusion::process(const StepEvent& step) {
  const Refusal verdict = insert(step);
  if (verdict == Refusal::kNone) note_pdr(step.stamp_ns);
  return count(Input::kStep, verdict);
}

Refusal Fusion::process(const HeadingRate& rate) {
  if (is_ahead_of_pdr(rate.stamp_ns)) return count(Input::kRate, Refusal::kOutOfRange);
  const Refusal verdict = insert(rate);
  if (verdict == Refusal::kNone) note_vision(rate.stamp_ns);
  return count(Input::kRate, verdict);
}

Refusal Fusion::process(const CorridorHeading& corridor) {
  if (is_ahead_of_pdr(corridor.stamp_ns)) return count(Input::kCorridor, Refusal::kOutOfRange);
  if (corridor.found && !std::isfinite(corridor.heading_rad + corridor.sigma_rad)) {
    return count(Input::kCorridor, Refusal::kNonFinite);
  }
  note_vision(corridor.stamp_ns);
  corridors_found_ += corridor.found ? 1 : 0;
  return count(Input::kCorridor, Refusal::kNone);
}

Refusal Fusion::insert(const Measurement& measurement) {
  if (!fusion::is_finite(measurement)) return Refusal::kNonFinite;
  if (!is_in_range(measurement)) return Refusal::kOutOfRange;
  const Refusal verdict = history_.insert(measurement);
  // What the one with vision takes is never too late for the other, which holds less.
  if (verdict == Refusal::kNone && config_.step.follow_pdr &&
      !std::holds_alternative<HeadingRate>(measurement)) {
    inertial_.insert(measurement);
  }
  return verdict;
}

Refusal Fusion::count(Input input, Refusal refusal) {
  ++inputs_[static_cast<std::size_t>(input)].by_refusal[static_cast<std::size_t>(refusal)];
  return refusal;
}

bool Fusion::is_ahead_of_pdr(TimestampNs stamp_ns) const {
  return pdr_ns_ && stamp_ns > *pdr_ns_ + to_ns(config_.history.horizon_s);
}

void Fusion::note_pdr(TimestampNs stamp_ns) {
  if (!is_newer(stamp_ns, pdr_ns_)) return;
  pdr_ns_ = stamp_ns;
  history_.forget_before(stamp_ns - to_ns(config_.history.horizon_s));
  inertial_.forget_before(stamp_ns - to_ns(config_.history.horizon_s));
}

void Fusion::note_vision(TimestampNs stamp_ns) {
  if (is_newer(stamp_ns, vision_ns_)) vision_ns_ = stamp_ns;
}

TimestampNs Fusion::newest_ns() const {
  return std::max(pdr_ns_.value_or(0), vision_ns_.value_or(pdr_ns_.value_or(0)));
}

FusionMode Fusion::mode() const {
  const FilterState& state = history_.state();
  if (!state.has_heading || !odometry_) return FusionMode::kWaiting;
  const TimestampNs now_ns = newest_ns();
  if (to_seconds(now_ns - *pdr_ns_) > config_.mode.pdr_timeout_s) return FusionMode::kCoasting;
  if (state.rate_ns && to_seconds(now_ns - *state.rate_ns) <= config_.mode.vision_timeout_s) {
    return FusionMode::kWithVision;
  }
  return FusionMode::kInertial;
}

std::optional<FusedPose> Fusion::latest() const {
  const FusionMode present_mode = mode();
  if (present_mode == FusionMode::kWaiting) return std::nullopt;
  const TimestampNs stamp_ns =
      present_mode == FusionMode::kCoasting ? newest_ns() : odometry_->stamp_ns;
  FilterState state = history_.state();
  history_.filter().predict(stamp_ns, state);

  FusedPose fused;
  fused.mode = present_mode;
  fused.yaw_rad = state.x[kYaw];
  fused.yaw_rate_radps = state.x[kRate];
  fused.distance_m = state.distance_m;
  fused.pose = *odometry_;
  fused.pose.stamp_ns = stamp_ns;
  fused.pose.position_m.head<2>() = state.x.segment<2>(kX) + news_of_pdr(state);
  if (config_.step.between_steps) {
    fused.pose.position_m.head<2>() += ahead_of_last_step(stamp_ns, state);
  }
  const Eigen::AngleAxisd turn(state.correction_rad, Eigen::Vector3d::UnitZ());
  fused.pose.world_from_body = (turn * odometry_->world_from_body).normalized();
  fused.pose.covariance = covariance_of(state);
  return fused;
}

/// How far the body has moved on since the last step's peak.
Eigen::Vector2d Fusion::ahead_of_last_step(TimestampNs stamp_ns, const FilterState& state) const {
  const double since_s = to_seconds(stamp_ns - state.last_step_ns);
  return beyond_last_step_m(since_s, state.last_step_period_s, state.last_step_m) *
         state.last_step_along;
}

/// What pdr's walk tells beyond its headings and steps.
Eigen::Vector2d Fusion::news_of_pdr(const FilterState& state) const {
  if (!config_.step.follow_pdr) return Eigen::Vector2d::Zero();
  FilterState inertial = inertial_.state();
  inertial_.filter().predict(odometry_->stamp_ns, inertial);
  const Eigen::Vector2d bend_m = pdr_walk_.position_m() - inertial.x.segment<2>(kX) -
                                 ahead_of_last_step(odometry_->stamp_ns, inertial);
  return news_in(bend_m, bent_variance_m2(state), bent_variance_m2(inertial));
}

Matrix6d Fusion::covariance_of(const FilterState& state) const {
  Matrix6d covariance = odometry_->covariance;
  for (const int free_of : {0, 1, 5}) {  // x, y and yaw are fusion's; the rest stays pdr's
    covariance.row(free_of).setZero();
    covariance.col(free_of).setZero();
  }
  const double silence_s = to_seconds(newest_ns() - *pdr_ns_);
  const bool coasting = silence_s > config_.mode.pdr_timeout_s;
  // Coasting, the held attitude errs by what the walker may have turned since.
  const StateVector attitude_row =
      coasting ? StateVector(StateVector::Unit(kYaw)) : history_.filter().attitude_yaw_row();
  const StateVector with_yaw = state.p * attitude_row;
  covariance.topLeftCorner<2, 2>() = state.p.block<2, 2>(kX, kX);
  covariance.block<2, 1>(0, 5) = with_yaw.segment<2>(kX);
  covariance.block<1, 2>(5, 0) = with_yaw.segment<2>(kX).transpose();
  covariance(5, 5) = attitude_row.dot(with_yaw);
  covariance.topLeftCorner<2, 2>() += body_about_steps(state);
  if (coasting) {
    const double strayed_m = config_.mode.coasting_speed_sigma_mps * silence_s;
    covariance.topLeftCorner<2, 2>().diagonal().array() += strayed_m * strayed_m;
  }
  return covariance;
}

/// What no step tells: how far the body is from where the last one put it.
Eigen::Matrix2d Fusion::body_about_steps(const FilterState& state) const {
  const StepConfig& step = config_.step;
  const double within_step = state.last_step_m * state.last_step_m / 12.0;  // uniform over a step
  const double unconfirmed = step.unconfirmed_sigma_m * step.unconfirmed_sigma_m;
  const double ahead = odometry_->speed_mps > 0.0 ? within_step : unconfirmed;
  const Eigen::Vector2d along(std::cos(state.x[kYaw]), std::sin(state.x[kYaw]));
  return step.sway_sigma_m * step.sway_sigma_m * Eigen::Matrix2d::Identity() +
         ahead * along * along.transpose();
}

FusionDiagnostics Fusion::diagnostics() const {
  const FilterState& state = history_.state();
  FusionDiagnostics out;
  out.inputs = inputs_;
  out.headings = state.headings;
  out.rates = state.rates;
  out.corridors_found = corridors_found_;
  out.reapplied = history_.reapplied();
  out.steps = state.steps;
  out.mode = mode();
  return out;
}

}  // namespace vpdr::fusion
