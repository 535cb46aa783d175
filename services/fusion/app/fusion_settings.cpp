#include "fusion/app/fusion_settings.hpp"

namespace vpdr::fusion {
namespace {

using config::above;
using config::at_least;
using config::between;
using config::Binder;

void bind(Binder& binder, HeadingConfig& heading) {
  binder.choice(
      "heading.transition", heading.transition,
      {{"corrected", TransitionForm::kCorrected}, {"as_printed", TransitionForm::kAsPrinted}},
      "matrix (9) of the heading-rate filter; as printed it forgets the heading");
  binder.number("heading.turn_density", heading.turn_density, above(0), "rad^2/s^3",
                "power density of the walker's angular acceleration");
  binder.number("heading.max_prediction_s", heading.max_prediction_s, above(0), "s",
                "a longer gap forgets the turn rate");
  binder.number("heading.turn_rate_sigma_radps", heading.turn_rate_sigma_radps, above(0), "rad/s",
                "turn rate of a walker of whom nothing is known");
  binder.choice("heading.noise", heading.noise,
                {{"correlated", HeadingNoise::kCorrelated}, {"white", HeadingNoise::kWhite}},
                "how pdr's heading errs; white: each time anew, as the equations are printed");
  binder.number("heading.correlation_time_s", heading.correlation_time_s, above(0), "s",
                "over which the slow part of pdr's heading error stays alike");
  binder.number("heading.white_sigma_rad", heading.white_sigma_rad, at_least(0), "rad",
                "part of pdr's deviation that is new each time");
  binder.number("heading.bias_sigma_rad", heading.bias_sigma_rad, at_least(0), "rad",
                "part of pdr's deviation that never changes: how the board is worn");
  binder.number("heading.delay_s", heading.delay_s, at_least(0), "s",
                "by which pdr's heading, a mean over the last step, lags behind");
  binder.number("heading.gate_sigmas", heading.gate_sigmas, above(0), "",
                "headings further off are refused");
  binder.number("heading.reset_after_s", heading.reset_after_s, at_least(0), "s",
                "pdr's heading is taken as it is when it was refused for so long");
}

void bind(Binder& binder, RateConfig& rate) {
  binder.choice("rate.noise", rate.noise,
                {{"chained", RateNoise::kChained}, {"white", RateNoise::kWhite}},
                "how vision's rate errs; white: each time anew, as the equations are printed");
  binder.number("rate.sway_sigma_rad", rate.sway_sigma_rad, at_least(0), "rad",
                "of the camera about the walking direction, in each frame");
  binder.number("rate.drift_density", rate.drift_density, at_least(0), "rad^2/s",
                "what does not cancel in the sum of the rates");
  binder.number("rate.gate_sigmas", rate.gate_sigmas, above(0), "",
                "rates further off are refused");
  binder.number("rate.max_chain_gap_s", rate.max_chain_gap_s, at_least(0), "s",
                "between the intervals of two rates that belong together");
}

void bind(Binder& binder, StepConfig& step) {
  binder.number("step.scale_sigma", step.scale_sigma, between(0, 1), "",
                "part of pdr's relative length deviation that is the person's, in all steps alike");
  binder.number("step.direction_sigma_rad", step.direction_sigma_rad, at_least(0), "rad",
                "of one step about the heading");
  binder.number("step.sway_sigma_m", step.sway_sigma_m, above(0), "m",
                "of the body about where the steps put it");
  binder.number("step.unconfirmed_sigma_m", step.unconfirmed_sigma_m, at_least(0), "m",
                "how far ahead the walker may be while pdr has not confirmed a walk");
  binder.flag("step.between_steps", step.between_steps,
              "carry the position on between steps by pdr's speed, half a step at most");
  binder.flag("step.follow_pdr", step.follow_pdr,
              "bend the walk as pdr bends its own, as far as vision did not already");
}

}  // namespace

void bind(Binder& binder, FusionConfig& config) {
  bind(binder, config.heading);
  bind(binder, config.rate);
  bind(binder, config.step);
  binder.number("history.horizon_s", config.history.horizon_s, above(0), "s",
                "a measurement later than this is refused");
  binder.integer("history.capacity", config.history.capacity, between(16, 1e6), "",
                 "measurements kept at most");
  binder.number("mode.pdr_timeout_s", config.mode.pdr_timeout_s, above(0), "s",
                "pdr counts as silent after this");
  binder.number("mode.vision_timeout_s", config.mode.vision_timeout_s, above(0), "s",
                "vision counts as silent after this");
  binder.number("mode.coasting_speed_sigma_mps", config.mode.coasting_speed_sigma_mps, above(0),
                "m/s", "what a walker may do unobserved");
}

}  // namespace vpdr::fusion
