#pragma once
// Straight corridors as a compass, softly (heuristic drift elimination: Borenstein and Ojeda,
// "Heuristic drift elimination for personnel tracking systems", Journal of Navigation 63, 2010).
// Most corridors of a building lie along one direction and across it. So where a walk goes straight
// for some steps, its direction is compared with what the straight stretches before have in common,
// modulo a quarter turn; what is left, if it is small, is probably drift: DeadReckoning's to judge.
// Stretches that agree little say little, curves and bends say nothing, and no walk is ever forced
// into the pattern.
// Angles ccw, rad. Not thread-safe; allocates nothing.
#include <array>
#include <complex>
#include <cstddef>
#include <optional>

namespace vpdr::pdr {

struct StraightConfig {
  bool use = true;               ///< with a magnetometer and without
  double sigma_rad = 0.2;        ///< rad, of a straight stretch about its corridor; (0.001, 3)
  double capture_rad = 0.2;      ///< rad, larger differences are no drift; (0, 0.7)
  double bend_rad = 0.1;         ///< rad, from the first to the last step of a stretch; (0, 1)
  double scatter_rad = 0.08;     ///< rad, r.m.s., of its steps; (0, 1)
  double memory_stretches = 20;  ///< over which directions are remembered; (1, 1e4)
  double least_agreement = 0.9;  ///< of them, 0 to 1, from which they are used; (0, 1)
};

/// Some steps straight on.
struct StraightStretch {
  double direction_rad = 0.0;
  double variance_rad2 = 0.0;  ///< about its corridor
  bool is_usual = false;       ///< along or across what the stretches before have in common
};

class StraightStretches {
 public:
  explicit StraightStretches(const StraightConfig& config) : config_(config) {}

  /// Walking direction of each confirmed step; every eighth ends a stretch.
  std::optional<StraightStretch> take(double yaw_rad);
  /// The steps so far were measured otherwise than those to come.
  void forget();

 private:
  static constexpr std::size_t kSteps = 8;

  [[nodiscard]] std::optional<double> straight_direction() const;

  StraightConfig config_;
  std::array<double, kSteps> yaws_{};
  std::size_t count_ = 0;
  std::complex<double> usual_ = 0.0;  ///< sum of exp(4 i direction)
  double weight_ = 0.0;               ///< number of stretches in it
};

}  // namespace vpdr::pdr
