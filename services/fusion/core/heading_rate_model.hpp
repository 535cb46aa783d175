#pragma once
// The model of heading-rate fusion, S1.10: state [theta_dot theta], its transition (9), and the
// measurement [theta_dot^v theta^m] = I state (10), the rate from vision and the heading from pdr.
// Radians, seconds. Pure functions.
#include <Eigen/Core>
#include <cstdint>

namespace vpdr::fusion {

/// Which transition matrix (9) is used.
enum class TransitionForm : std::uint8_t {
  kCorrected,  ///< [[1 0][dt 1]]: theta_{k+1} = theta_k + theta_dot dt, what (11) says
  kAsPrinted,  ///< [[1 0][dt 0]]: forgets theta_k; a baseline, not for use
};

/// (9): what `dt_s` seconds do to [theta_dot theta].
[[nodiscard]] Eigen::Matrix2d heading_rate_transition(double dt_s, TransitionForm form);

/// Covariance that a walker's turning adds within `dt_s`: the angular acceleration is white with
/// power density `turn_density` (rad^2/s^3), integrated once into the rate and twice into theta.
[[nodiscard]] Eigen::Matrix2d heading_rate_process_noise(double dt_s, double turn_density);

}  // namespace vpdr::fusion
