#include "fusion/core/heading_rate_model.hpp"

namespace vpdr::fusion {

Eigen::Matrix2d heading_rate_transition(double dt_s, TransitionForm form) {
  Eigen::Matrix2d f;
  f << 1.0, 0.0, dt_s, form == TransitionForm::kCorrected ? 1.0 : 0.0;
  return f;
}

Eigen::Matrix2d heading_rate_process_noise(double dt_s, double turn_density) {
  const double dt2 = dt_s * dt_s;
  Eigen::Matrix2d q;
  q << dt_s, 0.5 * dt2, 0.5 * dt2, dt2 * dt_s / 3.0;
  return turn_density * q;
}

}  // namespace vpdr::fusion
