#include "fusion/core/walker_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/square.hpp"

namespace vpdr::fusion {
namespace {

/// A larger revision of pdr's zero turns the walk as a whole, rad: along its tangents the walk
/// would grow.
constexpr double kLargeRevision = 0.3;

StateVector row_of(StateIndex index) { return StateVector::Unit(index); }

}  // namespace

FilterState WalkerFilter::initial() const {
  FilterState state;
  state.p(kRate, kRate) = square(config_.heading.turn_rate_sigma_radps);
  state.p(kBias, kBias) = bias_variance();
  state.p(kScale, kScale) = square(config_.step.scale_sigma);
  return state;
}

void WalkerFilter::apply(const Measurement& measurement, FilterState& state) const {
  predict(stamp_of(measurement), state);
  state.stamp_ns = stamp_of(measurement);
  std::visit([&](const auto& m) { use(m, state); }, measurement);
}

void WalkerFilter::predict(TimestampNs stamp_ns, FilterState& state) const {
  if (!state.has_heading || stamp_ns <= state.stamp_ns) return;
  const double dt_s = to_seconds(stamp_ns - state.stamp_ns);
  state.stamp_ns = stamp_ns;
  if (dt_s > config_.heading.max_prediction_s) {
    forget_rate(dt_s, state);
    return;
  }
  StateMatrix f = StateMatrix::Identity();
  f.topLeftCorner<2, 2>() = heading_rate_transition(dt_s, config_.heading.transition);
  const StateMatrix fp = f * state.p;
  state.p.noalias() = fp * f.transpose();
  state.p.topLeftCorner<2, 2>() += heading_rate_process_noise(dt_s, config_.heading.turn_density);
  state.x.head<2>() = f.topLeftCorner<2, 2>() * state.x.head<2>().eval();
  state.x[kYaw] = wrap_pi(state.x[kYaw]);
}

/// After a gap the walker may have turned any way: the old rate says nothing of it.
void WalkerFilter::forget_rate(double gap_s, FilterState& state) const {
  const double rate_variance = square(config_.heading.turn_rate_sigma_radps);
  state.x[kRate] = 0.0;
  make_independent(kRate, rate_variance, state);
  state.p(kYaw, kYaw) += std::min(rate_variance * square(gap_s), square(kPi));
}

double WalkerFilter::bias_variance() const {
  return is_correlated() ? square(config_.heading.bias_sigma_rad) : 0.0;
}

double WalkerFilter::white_sigma(double sigma_rad) const {
  return is_correlated() ? std::min(sigma_rad, config_.heading.white_sigma_rad) : sigma_rad;
}

double WalkerFilter::white_sigma(const HeadingEstimate& heading) const {
  if (!is_correlated() || heading.yaw_zero_sigma_rad <= 0.0) {
    return white_sigma(heading.yaw_sigma_rad);
  }
  const double rest =
      square(heading.yaw_sigma_rad) - square(heading.yaw_zero_sigma_rad) - bias_variance();
  return std::max(std::sqrt(std::max(rest, 0.0)), config_.heading.white_sigma_rad);
}

double WalkerFilter::correlated_sigma(const HeadingEstimate& heading) const {
  if (heading.yaw_zero_sigma_rad > 0.0) return heading.yaw_zero_sigma_rad;
  const double rest =
      square(heading.yaw_sigma_rad) - square(white_sigma(heading)) - bias_variance();
  return std::sqrt(std::max(rest, 0.0));
}

// --- heading of pdr: the second row of (10)

void WalkerFilter::use(const HeadingEstimate& heading, FilterState& state) const {
  if (!state.has_heading) {
    take_heading(heading, state);
  } else if (is_of_another_pdr(heading, state)) {  // what was walked stays where it is
    state.turns_about_m = state.x.segment<2>(kX);
    take_heading(heading, state);
  } else if (heading.yaw_is_absolute != state.yaw_is_absolute) {
    turn_world(heading, wrap_pi(heading.yaw_rad - state.x[kBias] - state.x[kYaw]), state);
  } else if (const double revision = wrap_pi(heading.yaw_revision_rad - state.revision_rad);
             std::abs(revision) > kLargeRevision) {
    turn_world(heading, revision, state);
  } else {
    revise(heading, state);
    pass_correlated_error(heading.stamp_ns, correlated_sigma(heading), state);
    // The delay holds for a steady rate; within a turn the mean may be off by all of it.
    const double variance = square(white_sigma(heading)) + square(delay_s() * state.x[kRate]);
    if (correct_yaw(heading.yaw_rad, delay_s(), variance, state)) {
      state.refusing_since_ns.reset();
    } else if (!state.refusing_since_ns) {
      state.refusing_since_ns = heading.stamp_ns;
    } else if (to_seconds(heading.stamp_ns - *state.refusing_since_ns) >=
               config_.heading.reset_after_s) {
      take_heading(heading, state);
      ++state.headings.resets;
    }
  }
  state.correction_rad = is_correlated() ? -(state.x[kCorrelated] + state.x[kBias])
                                         : wrap_pi(state.x[kYaw] - heading.yaw_rad);
}

bool WalkerFilter::correct_yaw(double measured_rad, double delay_s, double variance,
                               FilterState& state) const {
  const StateVector row =
      row_of(kYaw) - delay_s * row_of(kRate) + row_of(kCorrelated) + row_of(kBias);
  const Innovation innovation{wrap_pi(measured_rad - row.dot(state.x)), row, variance};
  return correct(innovation, config_.heading.gate_sigmas, state.headings, state);
}

/// pdr's zero of yaw had the variance `before` and has `after` now that it is revised. That is
/// worth a measurement -revision before / gone, of variance before after / gone, of the old error.
void WalkerFilter::revise(const HeadingEstimate& heading, FilterState& state) const {
  if (!is_correlated()) return;
  const double revision = heading.yaw_revision_rad - state.revision_rad;
  const double before = square(state.correlated_sigma_rad);
  const double after = square(correlated_sigma(heading));
  state.revision_rad = heading.yaw_revision_rad;
  if (heading.yaw_zero_sigma_rad <= 0.0 || before <= 0.0) return;
  const double gone = std::max(before - after, 0.0);
  const StateVector column = state.p.col(kCorrelated);
  const double spread = column[kCorrelated] * gone + before * after;
  const double error = -revision * before - state.x[kCorrelated] * gone;
  state.x += column * (error / spread);
  state.x[kYaw] = wrap_pi(state.x[kYaw]);
  state.x[kCorrelated] += revision;
  state.p.noalias() -= column * (column.transpose() * (gone / spread));
  state.correlated_sigma_rad = std::min(state.correlated_sigma_rad, std::sqrt(after));
}

/// First-order Gauss-Markov process whose unconditional deviation follows what pdr reports: it
/// grows by new noise and shrinks by shrinking the error itself.
void WalkerFilter::pass_correlated_error(TimestampNs stamp_ns, double sigma_rad,
                                         FilterState& state) const {
  const double dt_s = to_seconds(stamp_ns - state.heading_ns);
  const double old_sigma = state.correlated_sigma_rad;
  const double decay = std::exp(-dt_s / config_.heading.correlation_time_s);
  const double ratio = old_sigma > 0.0 ? std::min(decay, sigma_rad / old_sigma) : 0.0;
  state.x[kCorrelated] *= ratio;
  state.p.row(kCorrelated) *= ratio;
  state.p.col(kCorrelated) *= ratio;
  state.p(kCorrelated, kCorrelated) += square(sigma_rad) - square(ratio * old_sigma);
  state.correlated_sigma_rad = sigma_rad;
  state.heading_ns = stamp_ns;
}

/// theta = theta^m - correlated - bias - white, with a new correlated error: the first heading,
/// and the way back after a long disagreement. What was walked keeps its covariance.
void WalkerFilter::take_heading(const HeadingEstimate& heading, FilterState& state) const {
  const double sigma = correlated_sigma(heading);
  state.x[kRate] = 0.0;
  make_independent(kRate, square(config_.heading.turn_rate_sigma_radps), state);
  state.x[kYaw] = wrap_pi(heading.yaw_rad - state.x[kBias]);
  replace_by_copy(kYaw, kBias, -1.0, square(sigma) + square(white_sigma(heading)), state);
  state.x[kCorrelated] = 0.0;
  make_independent(kCorrelated, square(sigma), state);
  state.p(kYaw, kCorrelated) = state.p(kCorrelated, kYaw) = -square(sigma);
  state.correlated_sigma_rad = sigma;
  state.heading_ns = heading.stamp_ns;
  state.revision_rad = heading.yaw_revision_rad;
  state.stamp_ns = heading.stamp_ns;
  state.yaw_is_absolute = heading.yaw_is_absolute;
  state.has_heading = true;
  state.has_chain = false;
  state.refusing_since_ns.reset();
}

/// pdr found north (or lost it), or that the device does not point where its walker goes: yaw has
/// another zero, and pdr's track so far is turned about its start, as pdr turns its own. What was
/// uncertain of the old zero falls away, what is uncertain of the new one turns the whole track.
void WalkerFilter::turn_world(const HeadingEstimate& heading, double angle_rad,
                              FilterState& state) const {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  const Eigen::Vector2d walked = turn * (state.x.segment<2>(kX) - state.turns_about_m);
  state.x.segment<2>(kX) = state.turns_about_m + walked;
  state.last_step_along = (turn * state.last_step_along).eval();
  const Eigen::Vector2d lever(-walked.y(), walked.x());
  StateMatrix f = StateMatrix::Identity();
  f.block<2, 2>(kX, kX) = turn;
  f.block<2, 1>(kX, kYaw) = -lever;
  state.p = (f * state.p * f.transpose()).eval();
  take_heading(heading, state);
  f.setIdentity();
  f.block<2, 1>(kX, kYaw) = lever;
  state.p = (f * state.p * f.transpose()).eval();
}

StateVector WalkerFilter::attitude_yaw_row() const {
  return is_correlated() ? StateVector(-row_of(kCorrelated) - row_of(kBias)) : row_of(kYaw);
}

// --- rate of vision: the first row of (10)

void WalkerFilter::use(const HeadingRate& rate, FilterState& state) const {
  if (!state.has_heading) return;
  if (config_.rate.noise == RateNoise::kWhite) {
    apply_white_rate(rate, state);
  } else if (continues_chain(rate, state)) {
    apply_chained_rate(rate, state);
  } else {
    apply_white_rate(rate, state);
    begin_chain(rate, state);
  }
}

void WalkerFilter::apply_white_rate(const HeadingRate& rate, FilterState& state) const {
  const double interval_s = to_seconds(rate.stamp_ns - rate.interval_start_ns);
  const double sway = 2.0 * square(config_.rate.sway_sigma_rad / interval_s);
  const Innovation innovation{rate.rate_radps - state.x[kRate], row_of(kRate),
                              square(rate.sigma_radps) + sway};
  if (correct(innovation, config_.rate.gate_sigmas, state.rates, state)) {
    state.rate_ns = rate.stamp_ns;
  }
}

bool WalkerFilter::continues_chain(const HeadingRate& rate, const FilterState& state) const {
  const double gap_s = to_seconds(rate.interval_start_ns - state.chain_ns);
  return state.has_chain && std::abs(gap_s) <= config_.rate.max_chain_gap_s;
}

/// Variance of one frame's heading, of which a rate's error is the difference of two.
double WalkerFilter::frame_variance(const HeadingRate& rate) const {
  const double interval_s = to_seconds(rate.stamp_ns - rate.interval_start_ns);
  return 0.5 * square(rate.sigma_radps * interval_s) + square(config_.rate.sway_sigma_rad);
}

void WalkerFilter::apply_chained_rate(const HeadingRate& rate, FilterState& state) const {
  const double interval_s = to_seconds(rate.stamp_ns - rate.interval_start_ns);
  state.chain_turn_rad = wrap_pi(state.chain_turn_rad + rate.rate_radps * interval_s);
  state.chain_ns = rate.stamp_ns;
  state.p(kVisionZero, kVisionZero) += config_.rate.drift_density * interval_s;
  const double expected = state.x[kYaw] - state.x[kVisionZero];
  const Innovation innovation{wrap_pi(state.chain_turn_rad - expected),
                              row_of(kYaw) - row_of(kVisionZero), frame_variance(rate)};
  state.has_chain = correct(innovation, config_.rate.gate_sigmas, state.rates, state);
  if (state.has_chain) state.rate_ns = rate.stamp_ns;
}

void WalkerFilter::begin_chain(const HeadingRate& rate, FilterState& state) const {
  state.x[kVisionZero] = state.x[kYaw];
  replace_by_copy(kVisionZero, kYaw, 1.0, frame_variance(rate), state);
  state.chain_turn_rad = 0.0;
  state.chain_ns = rate.stamp_ns;
  state.has_chain = true;
  ++state.rates.resets;
}

}  // namespace vpdr::fusion
