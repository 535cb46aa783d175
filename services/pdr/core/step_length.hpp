#pragma once
// Length of a step from its frequency: SL = alpha f + beta (S1.2). The default is the walk ratio,
// length over cadence, that adults keep over their range of speeds: about 0.0065 m per (step/min)
// (Sekiya and Nagasaki, "Reproducibility of the walking patterns of normal young adults", Gait &
// Posture 7, 1998). Recorded walks between surveyed points give 0.0063, for corners cost length;
// alpha = 0.385 m/Hz lies between, and beta = 0. Pure, thread-safe, no errors.

namespace vpdr::pdr {

struct StepLengthConfig {
  double alpha_m_per_hz = 0.385;  ///< m/Hz, growth with step frequency; (0, 2)
  double beta_m = 0.0;            ///< m, length at frequency zero; (-2, 2)
  double shortest_m = 0.25;       ///< m, held above; (0, 1)
  double longest_m = 1.3;         ///< m, held below; (0.3, 3)
  double scale_sigma = 0.1;       ///< share, between persons: common to all steps; (0, 1)
  double step_sigma = 0.1;        ///< share, from step to step; (0, 1)
};

struct StepLength {
  double length_m = 0.0;
  double sigma_m = 0.0;  ///< person and step together
};

/// S1.2 with the length held within the configured range. Frequency in steps per second.
StepLength step_length(const StepLengthConfig& config, double frequency_hz);

}  // namespace vpdr::pdr
