#include "pdr/core/steps/step_length.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
constexpr double kAverageHeightM = 1.7;
constexpr double kLegShare = 0.53;
/// Length of a normal step as share of the height.
constexpr double kNormalStepShare = 0.415;
/// Grades of S3.2: swing of low, normal and high acceleration, m/s^2.
constexpr std::array<double, 3> kGrades{2.0, 5.0, 10.0};
/// Lengths of S3.2 over that of the normal step.
constexpr std::array<double, 3> kLengths{0.30 / 0.40, 1.0, 0.50 / 0.40};
/// Relation of S3.2: row i says how far acceleration of grade i goes with each of the lengths.
constexpr std::array<std::array<double, 3>, 3> kRelation{
    {{0.8, 0.2, 0.0}, {0.1, 0.8, 0.1}, {0.0, 0.2, 0.8}}};
/// Less than this is no step; a step of no length has no logarithm.
constexpr double kLeastM = 0.01;
/// The bounce of a step takes no longer than that of such a one; what follows is a halt.
constexpr double kSlowestBounceHz = 1.3;
/// A step that turns further is one on the spot: as long as one that turns so far.
constexpr double kLargestTurn = 1.2;
/// Spread of a walk's first step: it may be one of its later ones that is found first.
constexpr double kFirstSigma = 0.4;
/// Swing of an ordinary step on the trunk, m/s^2, and what is left of a smaller one at least.
constexpr double kOrdinarySwing = 4.0;
constexpr double kLeastShare = 0.1;
/// A learned distance this far from the modelled one, up or down, is no step's.
constexpr double kLargestRatio = 2.0;

double pendulum_factor(const StepLengthConfig& config, Carry carry) {
  switch (carry) {
    case Carry::kHand:
    case Carry::kPocket:
      return config.pendulum_in_hand;
    case Carry::kWaist:
    case Carry::kChest:
      return config.pendulum_on_trunk;
    case Carry::kHead:
      return config.pendulum_on_head;
    case Carry::kUnknown:
      break;
  }
  return config.pendulum_factor;
}
}  // namespace

std::array<double, 3> fuzzy_weights(double swing_mps2) {
  const double below = std::clamp((kGrades[1] - swing_mps2) / (kGrades[1] - kGrades[0]), 0.0, 1.0);
  const double above = std::clamp((swing_mps2 - kGrades[1]) / (kGrades[2] - kGrades[1]), 0.0, 1.0);
  return {below, 1.0 - below - above, above};
}

double fuzzy_length_m(double swing_mps2, double normal_step_m) {
  const std::array<double, 3> a = fuzzy_weights(swing_mps2);
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t j = 0; j < kLengths.size(); ++j) {
    double b = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) b += a[i] * kRelation[i][j];
    sum += b * kLengths[j];
    weights += b;
  }
  return normal_step_m * sum / weights;
}

double weinberg_length_m(double k, double swing_mps2) {
  return k * std::sqrt(std::sqrt(std::max(swing_mps2, 0.0)));
}

double pendulum_length_m(double frequency_hz, double swing_mps2, double leg_m) {
  const double omega = 2.0 * kPi * std::max(frequency_hz, kSlowestBounceHz);
  const double fall_m = std::max(swing_mps2, 0.0) / (omega * omega);
  return 2.0 * std::sqrt(2.0 * leg_m * fall_m);
}

StepLengthModel::StepLengthModel(const StepLengthConfig& config, double height_m, Carry carry)
    : config_(config),
      stature_(height_m > 0.0 ? height_m / kAverageHeightM : 1.0),
      leg_m_(kLegShare * kAverageHeightM * stature_),
      pendulum_factor_(pendulum_factor(config, carry)),
      pendulum_sigma_(carry == Carry::kUnknown ? config.unknown_sigma : config.pendulum_sigma),
      scale_sigma_(carry == Carry::kUnknown ? config.unknown_scale_sigma : config.scale_sigma),
      on_trunk_(carry == Carry::kWaist || carry == Carry::kChest),
      turns_alone_(carry == Carry::kHead) {}

StepLength StepLengthModel::length(const StepShape& step) const {
  const double level_m = std::clamp(scale_ * modelled_m(step), config_.shortest_m,
                                    std::max(config_.shortest_m, config_.longest_m));
  const double stepped_m = level_m + step.on_stairs * (config_.tread_m - level_m);
  StepLength out;
  out.length_m = share_of_step(step) * stepped_m;
  out.scale_sigma = learned_ < kLearnedFrom ? scale_sigma_ : config_.learned_sigma;
  // Either of the two, and the mean of them is neither.
  const double undecided = std::sqrt(step.on_stairs * (1.0 - step.on_stairs));
  const double own = step.sets_off ? kFirstSigma : config_.step_sigma;
  out.noise_m = std::hypot(own * out.length_m, undecided * (level_m - config_.tread_m));
  out.sigma_m = std::hypot(out.scale_sigma * out.length_m, out.noise_m);
  return out;
}

void StepLengthModel::learn_from_distance(double distance_m, const StepShape& step) {
  const double ratio = distance_m / (share_of_step(step) * modelled_m(step));
  if (!(ratio > 1.0 / kLargestRatio && ratio < kLargestRatio)) return;
  ratios_[learned_++ % kLearnedFrom] = ratio;
  if (learned_ < kLearnedFrom) return;
  scale_ = std::accumulate(ratios_.begin(), ratios_.end(), 0.0) / kLearnedFrom;
}

/// Whoever sets off is still gaining speed.
double StepLengthModel::share_of_step(const StepShape& step) const {
  return step.sets_off ? config_.first_share : 1.0;
}

double StepLengthModel::modelled_m(const StepShape& step) const {
  switch (config_.model) {
    case StepLengthKind::kLinear:
      return config_.alpha_m_per_hz * step.frequency_hz + config_.beta_m;
    case StepLengthKind::kWeinberg:
      return weinberg_length_m(config_.weinberg_k * stature_, step.swing_mps2);
    case StepLengthKind::kFuzzy:
      return fuzzy_length_m(step.swing_mps2, kNormalStepShare * kAverageHeightM * stature_);
    case StepLengthKind::kCombined:
      break;
  }
  const double turn = turns_alone_ ? 0.0 : std::min(std::abs(step.turn_rad), kLargestTurn);
  return std::cos(turn) * combined_m(step.frequency_hz, step.swing_mps2);
}

/// The part of a small swing that comes of the way walked: all of it in an ordinary step, none on
/// the spot.
double StepLengthModel::stepping_mps2(double swing_mps2) const {
  if (!on_trunk_ || swing_mps2 > kOrdinarySwing) return swing_mps2;
  const double marching = std::min(config_.marching_mps2, 0.9 * kOrdinarySwing);
  const double share = (swing_mps2 - marching) / (kOrdinarySwing - marching);
  return std::max(kLeastShare * swing_mps2, share * kOrdinarySwing);
}

double StepLengthModel::combined_m(double frequency_hz, double swing_mps2) const {
  const std::array<double, 3> lengths{
      stature_ * (config_.alpha_m_per_hz * frequency_hz + config_.beta_m),
      weinberg_length_m(config_.weinberg_k * stature_, swing_mps2),
      pendulum_factor_ * pendulum_length_m(frequency_hz, stepping_mps2(swing_mps2), leg_m_)};
  const std::array<double, 3> sigmas{config_.linear_sigma, config_.weinberg_sigma, pendulum_sigma_};
  // Their errors are relative: a weighted mean of the logarithms.
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double weight = 1.0 / (sigmas[i] * sigmas[i]);
    sum += weight * std::log(std::max(lengths[i], kLeastM));
    weights += weight;
  }
  return std::exp(sum / weights);
}

}  // namespace vpdr::pdr
