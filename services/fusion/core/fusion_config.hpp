#pragma once
// Everything that can be set about fusion; the defaults are the product.
#include <cstddef>
#include <cstdint>

#include "fusion/core/heading_rate_model.hpp"

namespace vpdr::fusion {

/// How the errors of pdr's heading are modelled.
enum class HeadingNoise : std::uint8_t {
  kCorrelated,  ///< a first-order Gauss-Markov error of pdr's sigma, a constant one, and a white
                ///< one
  kWhite,       ///< S1.10 to the letter: every heading is an independent measurement
};

/// How the errors of vision's rate are modelled.
enum class RateNoise : std::uint8_t {
  kChained,  ///< rate x interval is the difference of two frame headings: errors cancel in the sum
  kWhite,    ///< S1.10 to the letter: every rate is an independent measurement
};

/// Heading measured by pdr, and how fast a walker turns.
struct HeadingConfig {
  TransitionForm transition = TransitionForm::kCorrected;
  double turn_density = 2.0;           ///< rad^2/s^3, of the walker's angular acceleration
  double max_prediction_s = 0.8;       ///< a longer gap forgets the rate
  double turn_rate_sigma_radps = 1.0;  ///< of the rate where nothing is known of it
  HeadingNoise noise = HeadingNoise::kCorrelated;
  double correlation_time_s = 60.0;  ///< of the slow part of pdr's heading error
  double white_sigma_rad = 0.01;     ///< part of pdr's deviation that is new each time
  double bias_sigma_rad = 0.04;      ///< part that never changes: how the board is worn
  double delay_s = 0.28;             ///< pdr's heading is the mean over its last step
  double gate_sigmas = 3.3;          ///< innovations beyond are refused (1 dof: 99.9 %)
  double reset_after_s = 2.0;        ///< refused for so long: pdr's heading is taken as it is
};

/// Turn rate measured by vision.
struct RateConfig {
  RateNoise noise = RateNoise::kChained;
  double sway_sigma_rad = 0.03;   ///< of the head about the walking direction, in each frame
  double drift_density = 1e-6;    ///< rad^2/s, what does not cancel in the sum
  double gate_sigmas = 3.3;       ///< innovations beyond are refused
  double max_chain_gap_s = 1e-3;  ///< between the end of one interval and the start of the next
};

/// Dead reckoning.
struct StepConfig {
  double scale_sigma =
      0.1;  ///< part of pdr's relative deviation that is the person's: in all steps
  double direction_sigma_rad = 0.03;  ///< of one step about the heading
  double sway_sigma_m = 0.05;         ///< of the body about where the steps put it
  /// Ahead, while pdr says the walker stands: it holds back a walk's first steps until regular.
  double unconfirmed_sigma_m = 0.7;
  bool between_steps = true;  ///< carry the position on by pdr's speed, half a step at most
  bool follow_pdr = true;     ///< bend the walk as pdr bends its own, as far as vision did not
};

/// Late measurements.
struct HistoryConfig {
  double horizon_s = 5.0;       ///< a measurement later than this is refused
  std::size_t capacity = 4096;  ///< events kept at most
};

/// When a source counts as silent, in sensor time.
struct ModeConfig {
  double pdr_timeout_s = 1.0;
  double vision_timeout_s = 1.0;
  double coasting_speed_sigma_mps = 1.0;  ///< what a walker may do unobserved
};

struct FusionConfig {
  HeadingConfig heading;
  RateConfig rate;
  StepConfig step;
  HistoryConfig history;
  ModeConfig mode;
};

}  // namespace vpdr::fusion
