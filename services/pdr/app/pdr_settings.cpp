#include "pdr/app/pdr_settings.hpp"

#include "pdr/app/attitude_settings.hpp"

namespace vpdr::pdr {
namespace {

using config::above;
using config::at_least;
using config::between;
using config::Binder;
using config::open;

void bind_gait(Binder& binder, StepConfig& step) {
  binder.number("step.threshold_share", step.threshold_share, between(0, 1), "",
                "least height as share of the recent peaks'");
  binder.integer("step.confirming_steps", step.confirming_steps, between(4, 8), "",
                 "even peaks that make a walk");
  binder.integer("step.confirming_on_trunk", step.confirming_on_trunk, between(2, 8), "",
                 "peaks in a row that do, of a board on waist, chest or head");
  binder.number(
      "step.firm_mps2", step.firm_mps2, open(0, 20), "m/s^2",
      "there: height of a peak that is a step even where the weight is not seen to go over");
  binder.number("step.lateral_mps2", step.lateral_mps2, open(0, 20), "m/s^2",
                "there: across the walker, while one leg carries; where it changes sign is a step");
  binder.number("step.evenness", step.evenness, open(0.02, 2), "",
                "largest relative change from stride to stride");
  binder.number("step.resemblance", step.resemblance, open(-1, 1), "",
                "least correlation of a stride with the one before");
  binder.number("step.lasting_resemblance", step.lasting_resemblance, open(-1, 1), "",
                "the same while a walk goes on");
  binder.number("step.longest_stride_s", step.longest_stride_s, open(0.6, 6), "s",
                "of a walk that begins");
  binder.number("step.largest_rate_radps", step.largest_rate_radps, open(0.5, 50), "rad/s",
                "r.m.s. over a second; who spins faster does not walk");
  binder.number("step.rate_base_radps", step.rate_base_radps, open(0, 50), "rad/s",
                "who turns faster than this and ...");
  binder.number("step.rate_per_swing", step.rate_per_swing, between(0, 10), "rad/s / m/s^2",
                "... this for the bounce of the board handles it");
  binder.number("step.largest_tilt_rad", step.largest_tilt_rad, open(0, 3.2), "rad",
                "of the board against one stride before");
  binder.number("step.lasting_tilt_rad", step.lasting_tilt_rad, open(0, 3.2), "rad",
                "the same while a walk goes on");
}

void bind(Binder& binder, StepConfig& step) {
  binder.choice(
      "step.detector", step.detector,
      {{"gait", DetectorKind::kGait},
       {"peaks", DetectorKind::kPeaks},
       {"swing", DetectorKind::kSwing},
       {"spectrum", DetectorKind::kSpectrum}},
      "gait: peaks that belong to a walk; peaks, swing, spectrum: as the sources have it");
  binder.number("step.gap_s", step.gap_s, open(0.05, 10), "s",
                "a walk goes on through a silence up to this");
  binder.number("step.cutoff_hz", step.cutoff_hz, open(0.5, 20), "Hz",
                "of the Butterworth low-pass (gait, peaks)");
  binder.choice("step.filter_order", step.filter_order, {{"2", 2}, {"4", 4}}, "of the low-pass");
  binder.number("step.drift_time_s", step.drift_time_s, open(0.1, 60), "s",
                "over which the slow mean follows (gait, peaks)");
  binder.number("step.min_interval_s", step.min_interval_s, open(0.1, 2), "s",
                "shortest time between two steps (gait, peaks, swing)");
  binder.number("step.threshold_mps2", step.threshold_mps2, at_least(0), "m/s^2",
                "least height of a peak (gait, peaks)");
  binder.number("step.max_interval_s", step.max_interval_s, open(0.3, 5), "s",
                "a longer pause ends the walk");
  bind_gait(binder, step);
  binder.number("step.swing_threshold_mps2", step.swing_threshold_mps2, open(0, 50), "m/s^2",
                "a_max - a_min of a step (swing)");
  binder.number("step.spectrum_threshold_mps2", step.spectrum_threshold_mps2, open(0, 50), "m/s^2",
                "amplitude of the strongest frequency of a walk (spectrum)");
}

void bind(Binder& binder, StepLengthConfig& length) {
  binder.choice("step_length.model", length.model,
                {{"combined", StepLengthKind::kCombined},
                 {"linear", StepLengthKind::kLinear},
                 {"weinberg", StepLengthKind::kWeinberg},
                 {"fuzzy", StepLengthKind::kFuzzy}},
                "combined: of frequency, bounce and height; the others as the sources have them");
  binder.number("step_length.alpha_m_per_hz", length.alpha_m_per_hz, between(0, 2), "m/Hz",
                "growth with step frequency (linear)");
  binder.number("step_length.beta_m", length.beta_m, between(-2, 2), "m",
                "length at frequency zero (linear)");
  binder.number("step_length.weinberg_k", length.weinberg_k, open(0.05, 2), "",
                "length over the fourth root of a_max - a_min (weinberg)");
  binder.number("step_length.pendulum_factor", length.pendulum_factor, open(0.3, 3), "",
                "length over that of an inverted pendulum (combined), carry unknown");
  binder.number("step_length.pendulum_in_hand", length.pendulum_in_hand, open(0.3, 3), "",
                "the same for a board in hand or pocket");
  binder.number("step_length.pendulum_on_trunk", length.pendulum_on_trunk, open(0.3, 3), "",
                "the same for a board on waist or chest");
  binder.number("step_length.marching_mps2", length.marching_mps2, at_least(0), "m/s^2",
                "a_max - a_min of steps on the spot, of a board on waist or chest");
  binder.number("step_length.pendulum_on_head", length.pendulum_on_head, open(0.3, 3), "",
                "the same for a board on the head");
  binder.number("step_length.linear_sigma", length.linear_sigma, open(0.01, 1), "",
                "share, of the linear length: its weight in the combined one");
  binder.number("step_length.weinberg_sigma", length.weinberg_sigma, open(0.01, 1), "",
                "share, of Weinberg's length");
  binder.number("step_length.pendulum_sigma", length.pendulum_sigma, open(0.01, 1), "",
                "share, of the pendulum's length");
  binder.number("step_length.unknown_sigma", length.unknown_sigma, open(0.01, 1), "",
                "the same where carry is unknown");
  binder.number("step_length.shortest_m", length.shortest_m, open(0, 1), "m",
                "lengths are held above");
  binder.number("step_length.longest_m", length.longest_m, open(0.3, 3), "m",
                "lengths are held below");
  binder.number("step_length.scale_sigma", length.scale_sigma, between(0, 1), "",
                "share, between persons: common to all steps");
  binder.number("step_length.unknown_scale_sigma", length.unknown_scale_sigma, between(0, 1), "",
                "the same where carry is unknown");
  binder.number("step_length.learned_sigma", length.learned_sigma, between(0, 1), "",
                "the same once the person's scale was learned");
  binder.number("step_length.step_sigma", length.step_sigma, between(0, 1), "",
                "share, from step to step");
  binder.number("step_length.tread_m", length.tread_m, open(0.1, 1), "m", "a step on stairs");
  binder.number("step_length.first_share", length.first_share, open(0, 1.5), "",
                "of a step by which the body has gone on as it sets off");
}

void bind(Binder& binder, HeadingConfig& heading) {
  binder.number("heading.period_s", heading.period_s, open(0.005, 1), "s",
                "between published headings");
  binder.number("heading.window_s", heading.window_s, open(0.05, 4), "s",
                "averaged for the published heading while not walking");
  binder.number("heading.sway_sigma_rad", heading.sway_sigma_rad, between(0, 1), "rad",
                "of the direction from step to step, on the trunk");
  binder.number("heading.loose_sigma_rad", heading.loose_sigma_rad, between(0, 1), "rad",
                "the same in hand, pocket or where carry is unknown");
  binder.number("heading.turned_over_rad", heading.turned_over_rad, open(0, 3), "rad",
                "of tilt that make another way of carrying it");
  binder.number("heading.carried_on_sigma_rad", heading.carried_on_sigma_rad, open(0, 3), "rad",
                "how far a walker's direction changes while the device is moved");
}

void bind(Binder& binder, ForwardOffsetConfig& forward) {
  binder.number("forward.direction_sigma_rad", forward.direction_sigma_rad, open(0.01, 3), "rad",
                "of the walking direction that four steps tell");
  binder.number("forward.common_sigma_rad", forward.common_sigma_rad, open(0, 3), "rad",
                "of all of them alike");
  binder.number("forward.memory_steps", forward.memory_steps, open(4, 1e4), "",
                "steps over which they are remembered");
  binder.number("forward.aligned_in_hand", forward.aligned_in_hand, open(0, 1), "",
                "probability that a device in hand points forward");
  binder.number("forward.aligned_unknown", forward.aligned_unknown, open(0, 1), "",
                "the same where carry is unknown");
  binder.number("forward.confidence", forward.confidence, open(0.5, 1), "",
                "that it does not, from which the steps are believed");
}

void bind(Binder& binder, StraightConfig& straight) {
  binder.flag("straight.use", straight.use,
              "straight corridors hold the heading, with a magnetometer and without");
  binder.number("straight.sigma_rad", straight.sigma_rad, open(0.001, 3), "rad",
                "of eight straight steps about their corridor");
  binder.number("straight.capture_rad", straight.capture_rad, open(0, 0.7), "rad",
                "larger differences are no drift");
  binder.number("straight.bend_rad", straight.bend_rad, open(0, 1), "rad",
                "from first to last of steps that are straight");
  binder.number("straight.scatter_rad", straight.scatter_rad, open(0, 1), "rad",
                "r.m.s. of their directions");
  binder.number("straight.memory_stretches", straight.memory_stretches, open(1, 1e4), "",
                "over which corridors are remembered");
  binder.number("straight.least_agreement", straight.least_agreement, open(0, 1), "",
                "of corridors that are used; 1: all along one direction and across it");
}

void bind(Binder& binder, DeadReckoningConfig& reckoning) {
  binder.number("dead_reckoning.forward_sigma_rad", reckoning.forward_sigma_rad, open(0, 3), "rad",
                "of walking direction against the forward axis");
  binder.number("dead_reckoning.pocket_sigma_rad", reckoning.pocket_sigma_rad, open(0, 3), "rad",
                "the same of a board that is known to be in a pocket");
  binder.number("dead_reckoning.bias_sigma_radps", reckoning.bias_sigma_radps, open(0, 1), "rad/s",
                "of the gyroscope, each axis, before any rest");
  binder.number("dead_reckoning.bias_walk_radps_sqrt_s", reckoning.bias_walk_radps_sqrt_s,
                open(0, 0.1), "rad/s/sqrt(s)", "how the bias wanders");
  binder.number("dead_reckoning.rate_noise_rad_sqrt_s", reckoning.rate_noise_rad_sqrt_s,
                open(0, 0.1), "rad/sqrt(s)", "heading noise of the gyroscope");
  binder.number("dead_reckoning.turn_error", reckoning.turn_error, open(0, 0.1), "",
                "share of the rate: scale and cross-axis error");
  binder.number("dead_reckoning.rest_sigma_radps", reckoning.rest_sigma_radps, open(0, 0.1),
                "rad/s", "of the bias measured at rest");
  binder.number("dead_reckoning.sway_sigma_m", reckoning.sway_sigma_m, open(0, 1), "m",
                "of the body about where its steps put it");
  binder.number("dead_reckoning.unconfirmed_sigma_m", reckoning.unconfirmed_sigma_m, open(0, 10),
                "m", "how far ahead who seems to stand may be with a step under way");
  binder.number("dead_reckoning.height_sigma_m", reckoning.height_sigma_m, open(0, 100), "m",
                "of the height, which steps do not tell");
  binder.number("dead_reckoning.height_drift", reckoning.height_drift, between(0, 1), "",
                "m of height per m walked: slopes, stairs");
}

void bind(Binder& binder, FieldConfig& field) {
  binder.number("field.period_s", field.period_s, open(0.02, 10), "s", "of one mean field");
  binder.number("field.noise_ut", field.noise_ut, open(0, 100), "uT",
                "of a mean field, at least; more is learned from neighbouring ones");
  binder.number("field.strength_ut", field.strength_ut, open(0, 1000), "uT",
                "of the horizontal field, before anything was measured");
  binder.number("field.iron_sigma_ut", field.iron_sigma_ut, open(0, 100), "uT",
                "each axis, carried along with the body, left over by calibration");
  binder.number("field.disturbance_sigma_ut", field.disturbance_sigma_ut, open(0, 100), "uT",
                "each direction, by a building");
  binder.number("field.disturbance_length_m", field.disturbance_length_m, open(0.1, 1000), "m",
                "of the way over which a disturbance stays alike");
  binder.number("field.standing_mps", field.standing_mps, open(0, 10), "m/s",
                "way that time stands for without a step");
  binder.number("field.gate", field.gate, open(1, 1000), "",
                "normalised innovation squared beyond which a field says nothing of heading");
  binder.number("field.restart_sigma_ut", field.restart_sigma_ut, open(0, 1000), "uT",
                "of a disturbance that is taken anew");
}

void bind(Binder& binder, VerticalConfig& vertical) {
  binder.number("height.gust_sigma_m", vertical.gust_sigma_m, open(0, 10), "m",
                "of height, what wind and moving air do to it");
  binder.number("height.gust_time_s", vertical.gust_time_s, open(0, 60), "s",
                "over which a gust lasts");
  binder.number("height.weather_m_sqrt_s", vertical.weather_m_sqrt_s, open(0, 1), "m/sqrt(s)",
                "what weather and ventilation do");
  binder.number("height.floor_m_sqrt_s", vertical.floor_m_sqrt_s, open(0, 1), "m/sqrt(s)",
                "of walking: floors are not quite level");
  binder.number("height.stairs_mps", vertical.stairs_mps, open(0, 3), "m/s",
                "vertical speed on stairs");
  binder.number("height.stairs_sigma_mps", vertical.stairs_sigma_mps, open(0, 3), "m/s",
                "its spread");
  binder.number("height.lift_mps", vertical.lift_mps, open(0, 20), "m/s",
                "vertical speed of who climbs without a step");
  binder.number("height.lift_sigma_mps", vertical.lift_sigma_mps, open(0, 20), "m/s", "its spread");
  binder.number("height.speed_time_s", vertical.speed_time_s, open(0, 60), "s",
                "in which a vertical speed is reached");
  binder.number("height.level_time_s", vertical.level_time_s, open(1, 1e5), "s",
                "mean time between climbs");
  binder.number("height.climb_time_s", vertical.climb_time_s, open(1, 1000), "s",
                "mean length of a climb");
  binder.number("height.jump_m", vertical.jump_m, open(0, 100), "m",
                "of height, what a door does to the pressure for a moment");
  binder.number("height.lasting_jump_m", vertical.lasting_jump_m, open(0, 100), "m",
                "of height, what stays of it");
  binder.number("height.jump_every_s", vertical.jump_every_s, open(1, 1e5), "s",
                "mean time between doors");
}

void bind(Binder& binder, HeightConfig& height) {
  binder.number("height.temperature_k", height.temperature_k, open(200, 350), "K", "of the air");
  binder.number("height.period_s", height.period_s, open(0.05, 5), "s", "of one mean pressure");
  binder.number("height.noise_m", height.noise_m, open(0, 10), "m",
                "of its height, at least; more is learned");
  binder.number("height.stray_mps", height.stray_mps, open(0, 10), "m/s",
                "what a barometer that falls silent may miss");
  bind(binder, height.vertical);
  binder.number("height.floor_height_m", height.floors.floor_height_m, open(1, 20), "m",
                "from floor to floor, until the building's is learned");
  binder.number("height.settle_s", height.floors.settle_s, open(0.5, 60), "s",
                "on the level that end a climb; landings take less");
}

void bind(Binder& binder, SampleLimits& limits) {
  binder.number("limits.specific_force_mps2", limits.specific_force_mps2, above(0), "m/s^2",
                "larger readings are refused");
  binder.number("limits.angular_velocity_radps", limits.angular_velocity_radps, above(0), "rad/s",
                "larger readings are refused");
  binder.number("limits.field_ut", limits.field_ut, above(0), "uT", "larger readings are refused");
  binder.number("limits.pressure_min_pa", limits.pressure_min_pa, above(0), "Pa",
                "lower readings are refused");
  binder.number("limits.pressure_max_pa", limits.pressure_max_pa, above(0), "Pa",
                "higher readings are refused");
  binder.number("limits.time_jump_s", limits.time_jump_s, above(0), "s",
                "a stamp further from the last is refused unless the next bears it out");
}

}  // namespace

void bind(Binder& binder, PdrConfig& config) {
  binder.number("person.height_m", config.person.height_m, between(0, 2.6), "m",
                "of the walker, standing; 0: unknown");
  binder.choice("carry", config.carry,
                {{"unknown", Carry::kUnknown},
                 {"hand", Carry::kHand},
                 {"pocket", Carry::kPocket},
                 {"waist", Carry::kWaist},
                 {"chest", Carry::kChest},
                 {"head", Carry::kHead}},
                "where the board is worn; unknown serves all");
  bind(binder, config.attitude);
  bind(binder, config.step);
  bind(binder, config.step_length);
  bind(binder, config.heading);
  bind(binder, config.forward);
  bind(binder, config.straight);
  bind(binder, config.dead_reckoning);
  bind(binder, config.field);
  bind(binder, config.height);
  bind(binder, config.limits);
}

}  // namespace vpdr::pdr
