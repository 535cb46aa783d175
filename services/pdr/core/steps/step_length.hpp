#pragma once
// Length of a step from its frequency f and the swing s = a_max - a_min of its specific force.
//
//   linear    S1.2    L = alpha f + beta
//   weinberg  S1.12   L = K s^(1/4)
//   fuzzy     S3.2    three lengths weighed by B = A R
//   combined  own     L = (linear)^wl (weinberg)^ww (pendulum)^wp, weights by their deviations
//
// The pendulum: walking, the trunk swings over the standing leg. A vertical acceleration of swing
// s at the frequency f is a rise and fall by h = s / (2 pi f)^2, and a leg of length l that falls
// by h spans L = k 2 sqrt(2 l h) (Zijlstra and Hof, "Assessment of spatio-temporal gait parameters
// from trunk accelerations", Gait & Posture 18, 2003), l = 0.53 of the body's height. Recorded
// walks give k from 1.0 (phone in hand) to 1.2 (waist), running included, where the walk ratio
// L / f spreads from 0.22 to 0.5 m/Hz and K from 0.34 to 0.51. The head is spared the shock of the
// heel strike and rises as the centre of mass does, half as far as a stiff leg would have it (Gard
// and Childress, Prosthetics and Orthotics International 25, 2001): k = 1.4.
//
// Who marches on the spot bounces too, and gets nowhere. Below an ordinary swing of 4 m/s^2, waist
// and chest give a pendulum only what exceeds that of steps on the spot, so that shuffles about a
// kitchen come out as short as they are.
//
// On stairs it is the tread that gives the length.
//
// Who turns takes shorter steps: the inner leg's way is shorter and the outer one's no longer
// (Courtine and Schieppati, European Journal of Neuroscience 18, 2003); around figures of eight
// young walkers lose 8 % and old ones 14 % of their step (Frontiers in Neurology 12:698160, 2021).
// They bounce as before, so the combined length of a step that turns the board by psi is taken to
// be cos psi of the straight one. What swings forth and back with the two legs, an arm or a thigh,
// is no turn, for psi is that of a stride; but a head looks about without its owner. The linear
// model needs none of it, for the cadence falls with the length.
//
// Who sets off from a stand has walking speed when the first step ends (Breniere and Do, Journal of
// Biomechanics 19, 1986), so the body has gone little more than half of it: 0.51 to 0.60 of a step
// at the first peak of recorded walks that begin with a stand.
//
// What is true of one person in every step, the scale, is learned from walked distances (S1.13).
// Lengths grow with the person's height; it need not be known. SI. Not thread-safe; no errors.
#include <array>
#include <cstddef>
#include <cstdint>

#include "pdr/core/carry.hpp"
#include "pdr/core/steps/step_sequence.hpp"

namespace vpdr::pdr {

enum class StepLengthKind : std::uint8_t { kCombined, kLinear, kWeinberg, kFuzzy };

struct StepLengthConfig {
  StepLengthKind model = StepLengthKind::kCombined;
  /// m/Hz: the walk ratio, length over cadence, that adults keep over their range of speeds (Sekiya
  /// and Nagasaki, Gait & Posture 7, 1998); (0, 2)
  double alpha_m_per_hz = 0.385;
  double beta_m = 0.0;                ///< m, length at frequency zero; (-2, 2)
  double weinberg_k = 0.41;           ///< m / (m/s^2)^(1/4); (0.05, 2)
  double pendulum_factor = 1.2;       ///< k where it is not known how the board is worn; (0.3, 3)
  double pendulum_in_hand = 1.02;     ///< k of hand and pocket; (0.3, 3)
  double pendulum_on_trunk = 1.18;    ///< k of waist and chest; (0.3, 3)
  double marching_mps2 = 1.5;         ///< swing on waist and chest of steps on the spot; >= 0
  double pendulum_on_head = 1.4;      ///< k of the head; (0.3, 3)
  double linear_sigma = 0.25;         ///< share, spread of the walk ratio over walks; (0.01, 1)
  double weinberg_sigma = 0.15;       ///< share, of K; (0.01, 1)
  double pendulum_sigma = 0.08;       ///< share, of k; (0.01, 1)
  double unknown_sigma = 0.15;        ///< the same where it is not known how it is worn; (0.01, 1)
  double shortest_m = 0.15;           ///< m, held above; (0, 1)
  double longest_m = 1.5;             ///< m, held below; (0.3, 3)
  double scale_sigma = 0.08;          ///< share, between persons: common to all steps; (0, 1)
  double unknown_scale_sigma = 0.12;  ///< the same, worn nobody knows where; (0, 1)
  double learned_sigma = 0.03;        ///< share, the same once it was learned; (0, 1)
  double step_sigma = 0.1;            ///< share, from step to step; (0, 1)
  /// m, a step on stairs: the depth of a tread, 0.26 to 0.32 m by ISO 21542 and building codes;
  /// (0.1, 1)
  double tread_m = 0.29;
  double first_share = 0.6;  ///< of a step by which the body has gone on as it sets off; (0, 1.5)
};

struct StepLength {
  double length_m = 0.0;
  double sigma_m = 0.0;      ///< person and step together
  double noise_m = 0.0;      ///< of this step alone
  double scale_sigma = 0.0;  ///< share of the length: the person's part
};

/// S3.2: membership of an acceleration in "low", "normal" and "high", triangles between the three
/// grades; they sum to one.
std::array<double, 3> fuzzy_weights(double swing_mps2);
/// S3.2: B = A R over the relation R, then the mean of the paper's lengths, 0.30, 0.40 and 0.50 m
/// for its subject, weighed by B and scaled to the person's normal step.
double fuzzy_length_m(double swing_mps2, double normal_step_m);
/// S1.12.
double weinberg_length_m(double k, double swing_mps2);
/// The pendulum above, with k = 1.
double pendulum_length_m(double frequency_hz, double swing_mps2, double leg_m);

class StepLengthModel {
 public:
  /// @param height_m of the person; 0 where unknown.
  StepLengthModel(const StepLengthConfig& config, double height_m, Carry carry);

  /// Held within the configured range of lengths; on stairs a step is as long as a tread is deep.
  /// Only the combined model asks for the turn.
  [[nodiscard]] StepLength length(const StepShape& step) const;

  /// S1.13: a step on the level is known to have been so long, by vision or between known places.
  /// The scale becomes the mean of the last five, which for Weinberg's model is K = mean of
  /// L / s^(1/4). Lengths that no step has are left out.
  void learn_from_distance(double distance_m, const StepShape& step);
  /// Factor on every length: 1 until five distances were learned from.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  static constexpr std::size_t kLearnedFrom = 5;

  [[nodiscard]] double share_of_step(const StepShape& step) const;
  [[nodiscard]] double modelled_m(const StepShape& step) const;
  [[nodiscard]] double stepping_mps2(double swing_mps2) const;
  [[nodiscard]] double combined_m(double frequency_hz, double swing_mps2) const;

  StepLengthConfig config_;
  double stature_;  ///< height over that of an average adult
  double leg_m_;
  double pendulum_factor_;
  double pendulum_sigma_;
  double scale_sigma_;
  bool on_trunk_;     ///< bounces as the walker does
  bool turns_alone_;  ///< tells nothing of the walker's turns
  std::array<double, kLearnedFrom> ratios_{};
  std::size_t learned_ = 0;
  double scale_ = 1.0;
};

}  // namespace vpdr::pdr
