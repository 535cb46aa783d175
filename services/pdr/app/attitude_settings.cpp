#include "pdr/app/attitude_settings.hpp"

#include "core/rotation.hpp"

namespace vpdr::pdr {
namespace {

using config::between;
using config::Binder;
using config::open;

void bind_method(Binder& binder, AttitudeConfig& attitude) {
  binder.choice(
      "attitude.filter", attitude.filter,
      {{"default", AttitudeMethod::kErrorState}, {"complementary", AttitudeMethod::kComplementary}},
      "complementary: as the AHRS paper prints it, a baseline");
  binder.flag("attitude.use_magnetometer", attitude.use_magnetometer,
              "correct heading by the magnetometer");
  binder.number("attitude.sensor_delay_s", attitude.sensor_delay_s,
                {.min = 0, .max = 0.2, .open_max = true}, "s",
                "by which inertial readings are older than their stamps");
  binder.number("attitude.correction_period_s", attitude.correction_period_s, open(0.005, 1), "s",
                "between corrections");
  binder.number("attitude.heading_period_s", attitude.heading_period_s,
                {.min = 0, .max = 1, .open_max = true}, "s",
                "at least, between corrections of heading by the magnetometer");
  binder.number("attitude.levelling_s", attitude.levelling_s,
                {.min = 0, .max = 60, .open_max = true}, "s",
                "at the start, while the mean force is upright");
  binder.number("attitude.gap_s", attitude.gap_s, open(0.05, 10), "s",
                "a longer silence is not integrated over");
  binder.number("attitude.gap_rate_radps", attitude.gap_rate_radps, open(0, 10), "rad/s",
                "how fast the body may have turned in it");
  binder.number("attitude.saturated_force_mps2", attitude.saturated_force_mps2, open(0, 1000),
                "m/s^2", "what an accelerometer at its limit may hide");
  binder.number("attitude.saturated_rate_radps", attitude.saturated_rate_radps, open(0, 100),
                "rad/s", "what a gyroscope at its limit may hide");
}

void bind(Binder& binder, ComplementaryConfig& complementary) {
  binder.number("attitude.complementary.time_constant_s", complementary.time_constant_s,
                open(0.01, 600), "s", "where gyroscope and the other two cross over");
  binder.number("attitude.complementary.level_sigma_rad", complementary.level_sigma_rad, open(0, 3),
                "rad", "reported for roll and pitch");
  binder.number("attitude.complementary.heading_sigma_rad", complementary.heading_sigma_rad,
                open(0, 3), "rad", "reported for yaw");
}

void bind(Binder& binder, MagneticOffsetConfig& offset) {
  binder.number("attitude.magnetic.offset.prior_sigma_ut", offset.prior_sigma_ut, open(0.01, 1000),
                "uT", "board's own field of each axis before the body has turned");
  binder.number("attitude.magnetic.offset.memory_s", offset.memory_s, open(1, 3600), "s",
                "over which readings are remembered");
  binder.number("attitude.magnetic.offset.correlation_s", offset.correlation_s, open(0.01, 60), "s",
                "over which the field's error stays alike");
  binder.number("attitude.magnetic.offset.least_sigma_ut", offset.least_sigma_ut, open(0.01, 100),
                "uT", "of the field from place to place");
  binder.number("attitude.magnetic.offset.spread_memory_s", offset.spread_memory_s, open(0.1, 600),
                "s", "over which the misfit is judged");
}

void bind(Binder& binder, MagneticDelayConfig& delay) {
  binder.number("attitude.magnetic.delay.sigma_s", delay.sigma_s, open(0, 0.1), "s",
                "how far the field's delay may be from delay_s");
  binder.number("attitude.magnetic.delay.correlation_s", delay.correlation_s, open(0.01, 60), "s",
                "over which a misfit as quick as turns is alike");
  binder.number("attitude.magnetic.delay.largest_s", delay.largest_s, open(0, 0.2), "s",
                "what is found of it is held within");
  binder.number("attitude.magnetic.delay.least_sigma_s", delay.least_sigma_s, open(0, 0.1), "s",
                "of any sensor's delay, however well they agree");
}

void bind(Binder& binder, MagneticConfig& magnetic) {
  binder.number("attitude.magnetic.sigma_ut", magnetic.sigma_ut, open(0, 100), "uT",
                "each direction of an undisturbed field");
  binder.number("attitude.magnetic.initial_sigma_ut", magnetic.initial_sigma_ut, open(0, 100), "uT",
                "the same before anything was learned");
  binder.number("attitude.magnetic.correlation_s", magnetic.correlation_s, open(0.01, 600), "s",
                "over which a field's error stays alike");
  binder.number("attitude.magnetic.disturbance_memory_s", magnetic.disturbance_memory_s,
                open(0.01, 600), "s", "over which a disturbance is judged");
  binder.number("attitude.magnetic.gate", magnetic.gate, open(0.05, 10), "",
                "share of the field's strength beyond which it is not used");
  binder.number("attitude.magnetic.declination_rad", magnetic.declination_rad, open(-kPi, kPi),
                "rad", "magnetic north east of true north");
  binder.number("attitude.magnetic.delay_s", magnetic.delay_s,
                {.min = 0, .max = 0.2, .open_max = true}, "s",
                "by which a field is older than an inertial reading of the same stamp");
  binder.number("attitude.magnetic.known_field_s", magnetic.known_field_s,
                {.min = 0, .max = 3600, .open_max = true}, "s",
                "of readings that the calibrated field stands for at the start");
  bind(binder, magnetic.offset);
  bind(binder, magnetic.delay);
}

void bind_start(Binder& binder, AttitudeErrorConfig& error) {
  binder.number("attitude.error.initial_tilt_sigma_rad", error.initial_tilt_sigma_rad, open(0, 3),
                "rad", "of coarse levelling, at most");
  binder.number("attitude.error.least_tilt_sigma_rad", error.least_tilt_sigma_rad, open(0, 3),
                "rad", "of coarse levelling, at least");
  binder.number("attitude.error.initial_bias_sigma_radps", error.initial_bias_sigma_radps,
                open(0, 1), "rad/s", "bias of each gyroscope axis at the start");
  binder.number("attitude.error.initial_scale_sigma", error.initial_scale_sigma, open(0, 0.2), "",
                "scale error of each gyroscope axis");
}

void bind_noise(Binder& binder, AttitudeErrorConfig& error) {
  binder.number("attitude.error.bias_walk_radps_sqrt_s", error.bias_walk_radps_sqrt_s, open(0, 0.1),
                "rad/s/sqrt(s)", "how the bias wanders");
  binder.number("attitude.error.rate_noise_rad_sqrt_s", error.rate_noise_rad_sqrt_s, open(0, 0.1),
                "rad/sqrt(s)", "gyroscope noise");
  binder.number("attitude.error.turning_error", error.turning_error, open(0, 0.1), "",
                "share of the rate: cross-axis error");
  binder.number("attitude.error.force_noise_mps2_sqrt_s", error.force_noise_mps2_sqrt_s,
                open(0, 10), "m/s/sqrt(s)", "accelerometer noise");
  binder.number("attitude.error.no_gyro_rate_radps", error.no_gyro_rate_radps, open(0, 10), "rad/s",
                "turning of a body without gyroscope");
}

void bind_honesty(Binder& binder, AttitudeErrorConfig& error) {
  HorizonBaseConfig& base = error.base;
  CorrectionScaleConfig& scale = error.scale;
  binder.number("attitude.error.base.sigma_rad", base.sigma_rad, open(0, 1), "rad",
                "accelerometer offset and mounting, before anything was seen of it");
  binder.number("attitude.error.base.kept_share", base.kept_share,
                {.min = 0, .max = 1, .open_min = true}, "", "of its variance that always stays");
  binder.number("attitude.error.base.memory_s", base.memory_s, open(1, 3600), "s",
                "over which the vertical force, which tells it, is averaged");
  binder.number("attitude.error.heading_base_sigma_rad", error.heading_base_sigma_rad,
                {.min = 0, .max = 1, .open_max = true}, "rad", "of the place's north and mounting");
  binder.number("attitude.error.timing_sigma_s", error.timing_sigma_s, open(0, 0.1), "s",
                "of the sensors' delay, as long as unknown");
  binder.number("attitude.error.scale.block_s", scale.block_s, open(0.1, 600), "s",
                "over which corrections are summed up");
  binder.number("attitude.error.scale.memory_s", scale.memory_s, open(0.1, 3600), "s",
                "over which they tell how large the errors are");
  binder.number("attitude.error.scale.least", scale.least, {.min = 0, .max = 1, .open_min = true},
                "", "factor of variances, however calm it is");
  binder.number("attitude.error.scale.largest", scale.largest,
                {.min = 1, .max = 1e6, .open_max = true}, "", "factor of one block, however wild");
}

void bind(Binder& binder, AttitudeErrorConfig& error) {
  bind_start(binder, error);
  bind_noise(binder, error);
  binder.number("attitude.error.usual_speed_mps", error.usual_speed_mps, open(0.01, 20), "m/s",
                "of each axis, before any was seen");
  binder.number("attitude.error.least_speed_mps", error.least_speed_mps, open(0.001, 10), "m/s",
                "of the calmest movement");
  binder.number("attitude.error.speed_correlation_s", error.speed_correlation_s, open(0.01, 60),
                "s", "over which a velocity stays alike");
  binder.number("attitude.error.speed_memory_s", error.speed_memory_s, open(0.1, 600), "s",
                "over which the speed is judged");
  binder.number("attitude.error.rest_speed_mps", error.rest_speed_mps, open(1e-4, 1), "m/s",
                "at rest");
  binder.number("attitude.error.rest_sigma_radps", error.rest_sigma_radps, open(0, 0.1), "rad/s",
                "of one mean rate at rest");
  binder.number("attitude.error.heading_tolerance_rad", error.heading_tolerance_rad, open(0, 3),
                "rad", "a field that differs less is as usual");
  binder.number("attitude.error.heading_surprise", error.heading_surprise, open(1, 1e6), "",
                "variances beyond which a field counts less");
  bind_honesty(binder, error);
  binder.number("attitude.error.largest_bias_radps", error.largest_bias_radps, open(0, 1), "rad/s",
                "the bias is held within");
}

void bind(Binder& binder, RestConfig& rest) {
  binder.number("attitude.rest.block_s", rest.block_s, open(0.05, 2), "s", "length of one block");
  binder.integer("attitude.rest.blocks", rest.blocks, between(2, 16), "",
                 "still blocks in a row that make a rest");
  binder.number("attitude.rest.rate_std_radps", rest.rate_std_radps, open(0, 1), "rad/s",
                "spread of each axis within a block");
  binder.number("attitude.rest.rate_step_radps", rest.rate_step_radps, open(0, 1), "rad/s",
                "between block means");
  binder.number("attitude.rest.force_std_mps2", rest.force_std_mps2, open(0, 10), "m/s^2",
                "spread of each axis within a block");
  binder.number("attitude.rest.force_step_mps2", rest.force_step_mps2, open(0, 10), "m/s^2",
                "between block means");
  binder.number("attitude.rest.largest_bias_radps", rest.largest_bias_radps, open(0, 1), "rad/s",
                "a faster steady rate is a turn, not a bias");
}

}  // namespace

void bind(Binder& binder, AttitudeConfig& config) {
  bind_method(binder, config);
  bind(binder, config.complementary);
  bind(binder, config.magnetic);
  bind(binder, config.error);
  bind(binder, config.rest);
}

}  // namespace vpdr::pdr
