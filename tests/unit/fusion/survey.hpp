#pragma once
// What the tests of S1.10 and S1.3 with hand-worked numbers have in common: white noises, so that
// the printed equations remain.
#include "fusion/core/fusion_config.hpp"
#include "fusion/core/measurement.hpp"

namespace vpdr::fusion::survey {

inline constexpr TimestampNs kSecond = kNsPerSecond;

inline FusionConfig as_in_the_survey() {
  FusionConfig config;
  config.heading.noise = HeadingNoise::kWhite;
  config.rate.noise = RateNoise::kWhite;
  config.heading.turn_density = 3.0;
  config.heading.turn_rate_sigma_radps = 2.0;
  config.heading.max_prediction_s = 10.0;
  config.rate.sway_sigma_rad = 0.0;
  config.step = {.scale_sigma = 0.0, .direction_sigma_rad = 0.0};
  return config;
}

inline HeadingEstimate heading(double at_s, double yaw, double sigma) {
  return {.stamp_ns = to_ns(at_s), .yaw_rad = yaw, .yaw_sigma_rad = sigma};
}

inline HeadingRate rate(double at_s, double value, double sigma, double interval_s = 0.05) {
  return {.stamp_ns = to_ns(at_s),
          .interval_start_ns = to_ns(at_s - interval_s),
          .rate_radps = value,
          .sigma_radps = sigma};
}

inline StepEvent step(double at_s, double length, double sigma = 0.0) {
  StepEvent event;
  event.stamp_ns = to_ns(at_s);
  event.length_m = length;
  event.length_sigma_m = sigma;
  event.yaw_sigma_rad = 0.1;
  return event;
}

}  // namespace vpdr::fusion::survey
