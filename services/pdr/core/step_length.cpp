#include "pdr/core/step_length.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

StepLength step_length(const StepLengthConfig& config, double frequency_hz) {
  StepLength step;
  step.length_m = std::clamp(config.alpha_m_per_hz * frequency_hz + config.beta_m,
                             config.shortest_m, std::max(config.shortest_m, config.longest_m));
  step.sigma_m = step.length_m * std::hypot(config.scale_sigma, config.step_sigma);
  return step;
}

}  // namespace vpdr::pdr
