#include "pdr/core/heading/forward_offset.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "core/square.hpp"

namespace vpdr::pdr {

namespace {

using Complex = std::complex<double>;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Four steps take no longer; what does has a halt in it.
constexpr double kLongestWindow = 4.0;
/// Fewer entries show no phase.
constexpr int kLeastEntries = 24;
/// A weaker swing is noise, m/s^2.
constexpr double kLeastSwing = 0.1;
/// Who steps so often, bounces so much and flies between the steps runs. A hurried walker's steps
/// are as many and as hard, but one foot always carries: the upward force never vanishes.
constexpr double kRunningHz = 2.3;
constexpr double kRunningBounce = 6.0;
constexpr double kFlight_mps2 = 0.5;

/// Logarithm of the modified Bessel function I0: by its series, and its asymptote.
double log_bessel(double x) {
  if (x > 12.0) return x - 0.5 * std::log(2.0 * kPi * x) + 0.125 / x;
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; k < 40; ++k) {
    term *= square(0.5 * x / k);
    sum += term;
  }
  return std::log(sum);
}

/// In a pocket a device lies anyhow: so much concentration of the sum, 30 degrees, is believed.
constexpr double kClearEnough = 4.0;

double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }

}  // namespace

ForwardOffset::ForwardOffset(const ForwardOffsetConfig& config, Carry carry)
    : config_(config),
      known_(on_trunk(carry)),
      anyhow_(carry == Carry::kPocket),
      in_hand_(carry == Carry::kHand),
      has_sides_(in_hand_),
      first_log_odds_(log_odds(in_hand_ ? config.aligned_in_hand : config.aligned_unknown)),
      log_odds_aligned_(first_log_odds_) {}

void ForwardOffset::add(TimestampNs stamp_ns, const Eigen::Quaterniond& frame_from_body,
                        const Vector2d& heading, const Vector3d& specific_force_mps2) {
  if (known_) return;
  if (count_ > 0 && stamp_ns < at(0).stamp_ns) count_ = 0;
  if (samples_ == 0) sum_ = Entry{stamp_ns, Vector3d::Zero(), Vector2d::Zero()};
  ++samples_;
  sum_.force_mps2 += frame_from_body * specific_force_mps2;
  sum_.heading += heading;
  if (count_ > 0 && stamp_ns - at(0).stamp_ns < kSpacing) return;
  Entry entry = sum_;
  entry.stamp_ns = sum_.stamp_ns + (stamp_ns - sum_.stamp_ns) / 2;
  entry.force_mps2 /= samples_;
  entry.heading /= samples_;
  samples_ = 0;
  entries_[next_] = entry;
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

std::optional<FoundOffset> ForwardOffset::take(const DetectedStep& step) {
  if (known_) return std::nullopt;
  const bool goes_on = window_steps_ > 0 && step.previous_ns == last_step_ns_;
  last_step_ns_ = step.stamp_ns;
  window_steps_ = goes_on ? window_steps_ + 1 : 1;
  if (window_steps_ == 1) window_begin_ns_ = step.stamp_ns;
  if (window_steps_ <= kWindowSteps) return std::nullopt;
  const TimestampNs begin_ns = window_begin_ns_;
  window_begin_ns_ = step.stamp_ns;
  window_steps_ = 1;
  const std::optional<Vector2d> seen = direction(begin_ns, step.stamp_ns);
  if (!seen) return std::nullopt;
  const double kept = std::exp(-kWindowSteps / config_.memory_steps);
  directions_ = kept * directions_ + *seen;
  return judge();
}

void ForwardOffset::carried_anew(bool may_point_forward) {
  anyhow_ = !may_point_forward;
  has_sides_ = in_hand_ && may_point_forward;
  side_rad_ = 0.0;
  log_odds_aligned_ = first_log_odds_;
  found_ = false;
  directions_.setZero();
  window_steps_ = 0;
}

void ForwardOffset::carried_on(double sigma_rad) {
  has_sides_ = false;
  log_odds_aligned_ = std::min(log_odds_aligned_, log_odds(config_.aligned_unknown));
  // So many unit vectors are as sure as that.
  const double most = square(config_.direction_sigma_rad / sigma_rad);
  if (directions_.norm() > most) directions_ *= most / directions_.norm();
  window_steps_ = 0;
}

/// Bayes' decision between "it points forward" and "it points anywhere", each d a von Mises
/// variable about the offset: the odds are exp(k n_x) / I0(k |n|) with the sum n of them.
std::optional<FoundOffset> ForwardOffset::judge() {
  if (has_sides_) return judge_sides();
  const double concentration = 1.0 / square(config_.direction_sigma_rad);
  const double length = directions_.norm();
  const double odds =
      log_odds_aligned_ + concentration * directions_.x() - log_bessel(concentration * length);
  const bool sure =
      anyhow_ ? concentration * length > kClearEnough : odds < -log_odds(config_.confidence);
  if (!found_ && !sure) return std::nullopt;
  found_ = true;
  FoundOffset found;
  found.offset_rad = std::atan2(directions_.y(), directions_.x());
  found.variance_rad2 =
      square(config_.common_sigma_rad) + 1.0 / (concentration * std::max(length, 0.1));
  return found;
}

/// A hand holds a device by one of its four sides, mostly the same.
std::optional<FoundOffset> ForwardOffset::judge_sides() {
  constexpr std::array<double, 4> kSides{0.0, 0.5 * kPi, kPi, -0.5 * kPi};
  const double concentration = 1.0 / square(config_.direction_sigma_rad);
  std::array<double, 4> odds{};  // against any of the other three
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    odds[i] = concentration * directions_.dot(Vector2d(std::cos(kSides[i]), std::sin(kSides[i])));
  }
  odds[0] += log_odds_aligned_ + std::log(3.0);
  const auto best = std::max_element(odds.begin(), odds.end());
  double others = 0.0;
  for (auto side = odds.begin(); side != odds.end(); ++side) {
    if (side != best) others += std::exp(*side - *best);
  }
  if (others > 1.0 - config_.confidence) return std::nullopt;
  const double offset = kSides[static_cast<std::size_t>(best - odds.begin())];
  if (offset == side_rad_) return std::nullopt;
  side_rad_ = offset;
  return FoundOffset{offset, square(config_.common_sigma_rad)};
}

std::optional<Vector2d> ForwardOffset::direction(TimestampNs begin_ns, TimestampNs end_ns) const {
  const double duration = to_seconds(end_ns - begin_ns);
  if (duration <= 0.0 || duration > kLongestWindow) return std::nullopt;
  Eigen::Matrix<Complex, 3, 1> swing = Eigen::Matrix<Complex, 3, 1>::Zero();
  Complex unit_sum = 0.0;
  Vector3d mean = Vector3d::Zero();
  Vector2d heading = Vector2d::Zero();
  double least_upward = kGravityMps2;
  int entries = 0;
  for (std::size_t age = 0; age < count_ && at(age).stamp_ns > begin_ns; ++age) {
    const Entry& entry = at(age);
    if (entry.stamp_ns > end_ns) continue;
    const double cycles = kWindowSteps * to_seconds(entry.stamp_ns - begin_ns) / duration;
    const Complex unit = std::polar(1.0, -2.0 * kPi * cycles);
    swing += unit * entry.force_mps2;
    unit_sum += unit;
    mean += entry.force_mps2;
    heading += entry.heading;
    least_upward = std::min(least_upward, entry.force_mps2.z());
    ++entries;
  }
  if (entries < kLeastEntries) return std::nullopt;
  swing = (2.0 / entries * (swing - unit_sum * (mean / entries))).eval();
  const double bounce = std::abs(swing.z());
  if (bounce < kLeastSwing || heading.isZero()) return std::nullopt;
  Vector2d forward((swing.x() * std::conj(swing.z())).imag() / bounce,
                   (swing.y() * std::conj(swing.z())).imag() / bounce);
  if (forward.norm() < kLeastSwing) return std::nullopt;
  const bool runs = kWindowSteps / duration > kRunningHz && bounce > kRunningBounce &&
                    least_upward < kFlight_mps2;
  if (runs) forward = -forward;
  const Vector2d ahead = heading.normalized();
  return Vector2d(ahead.dot(forward), ahead.x() * forward.y() - ahead.y() * forward.x())
      .normalized();
}

}  // namespace vpdr::pdr
