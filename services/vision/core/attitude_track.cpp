#include "vision/core/attitude_track.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

// Four seconds at the fastest board's rate: no frame is older when it arrives.
constexpr std::size_t kCapacity = 4096;

}  // namespace

std::optional<Eigen::Quaterniond> turn_between(const std::optional<AttitudePrior>& earlier,
                                               const std::optional<AttitudePrior>& later) {
  if (!earlier || !later || !earlier->turn || !later->turn) return std::nullopt;
  if (earlier->turn->epoch != later->turn->epoch) return std::nullopt;
  return (earlier->turn->start_from_body.conjugate() * later->turn->start_from_body).normalized();
}

AttitudeTrack::AttitudeTrack(const AttitudeTrackConfig& config)
    : config_(config), ring_(kCapacity) {}

const AttitudeTrack::Entry& AttitudeTrack::entry(std::size_t age) const {
  return ring_[(count_ - 1 - age) % kCapacity];
}

std::optional<TimestampNs> AttitudeTrack::newest_ns() const {
  if (count_ == 0) return std::nullopt;
  return entry(0).stamp_ns;
}

void AttitudeTrack::add(const AttitudeEstimate& a) {
  if (count_ > 0 && a.stamp_ns <= entry(0).stamp_ns) return;
  Entry next;
  next.stamp_ns = a.stamp_ns;
  next.world_from_body = a.world_from_body;
  next.inclination_sigma_rad =
      std::sqrt(std::max({0.0, a.covariance_rad2(0, 0), a.covariance_rad2(1, 1)}));
  next.rate_radps = a.angular_velocity_radps;
  next.up_rate_radps = (a.world_from_body * a.angular_velocity_radps).z();
  if (count_ > 0) {
    const Entry& last = entry(0);
    const double dt = to_seconds(next.stamp_ns - last.stamp_ns);
    next.turn = last.turn;
    next.turn.rad += 0.5 * (last.up_rate_radps + next.up_rate_radps) * dt;
    next.turn.start_from_body =
        (last.turn.start_from_body * exp_rotation(0.5 * dt * (last.rate_radps + next.rate_radps)))
            .normalized();
    if (dt > config_.max_gap_s) {
      next.turn = {0.0, last.turn.epoch + 1, Eigen::Quaterniond::Identity()};
    }
  }
  ring_[count_ % kCapacity] = next;
  ++count_;
}

bool AttitudeTrack::is_due(TimestampNs stamp_ns) const {
  return count_ > 0 && stamp_ns <= entry(0).stamp_ns;
}

std::optional<AttitudePrior> AttitudeTrack::at(TimestampNs stamp_ns) const {
  if (!is_due(stamp_ns)) return std::nullopt;
  const std::size_t kept = std::min(count_, kCapacity);
  std::size_t age = 0;
  while (age < kept && entry(age).stamp_ns > stamp_ns) ++age;
  if (age == kept) return std::nullopt;
  const Entry& before = entry(age);
  const Entry& after = before.stamp_ns < stamp_ns ? entry(age - 1) : before;
  const double gap = to_seconds(after.stamp_ns - before.stamp_ns);
  if (gap > config_.max_gap_s) return std::nullopt;
  const double share = gap > 0.0 ? to_seconds(stamp_ns - before.stamp_ns) / gap : 0.0;
  AttitudePrior prior;
  prior.world_from_body = before.world_from_body.slerp(share, after.world_from_body);
  prior.inclination_sigma_rad =
      std::hypot(config_.mounting_sigma_rad,
                 std::max(before.inclination_sigma_rad, after.inclination_sigma_rad));
  prior.turn = before.turn;
  prior.turn->rad += share * (after.turn.rad - before.turn.rad);
  prior.turn->start_from_body =
      before.turn.start_from_body.slerp(share, after.turn.start_from_body);
  return prior;
}

}  // namespace vpdr::vision
