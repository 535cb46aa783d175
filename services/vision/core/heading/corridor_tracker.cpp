#include "vision/core/heading/corridor_tracker.hpp"

#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

constexpr double kQuarter = 0.5 * kPi;

}  // namespace

void CorridorTracker::predict(const std::optional<GyroTurn>& turn) {
  const bool comparable = turn && last_turn_ && last_turn_->epoch == turn->epoch;
  if (comparable && heading_) *heading_ += turn->rad - last_turn_->rad;
  predicted_by_turn_ = predicted_by_turn_ && comparable;
  last_turn_ = turn;
}

CorridorTracker::Followed CorridorTracker::follow(const QuarterHeading& measured) {
  const double predicted = heading_.value_or(measured.heading_rad);
  double heading = measured.heading_rad + offset_rad_;
  heading += kQuarter * std::round((predicted - heading) / kQuarter);
  const double difference = predicted - heading;
  if (predicted_by_turn_ && std::abs(difference) > config_.max_disagreement_rad) {
    if (!anchor_anew(difference)) return {FrameOutcome::kDisagrees, heading, std::nullopt};
    offset_rad_ += difference;
    heading = predicted;
    previous_.reset();
  }
  disagreeing_ = 0;
  Followed out{FrameOutcome::kFound, heading, rate_to(measured, heading)};
  heading_ = heading;
  predicted_by_turn_ = last_turn_.has_value();
  previous_ = Previous{measured.stamp_ns, heading, measured.noise_rad};
  return out;
}

std::optional<HeadingRate> CorridorTracker::rate_to(const QuarterHeading& measured,
                                                    double heading) const {
  if (!previous_) return std::nullopt;
  const double dt = to_seconds(measured.stamp_ns - previous_->stamp_ns);
  if (!(dt > 0.0) || dt > config_.max_rate_interval_s) return std::nullopt;
  HeadingRate rate;
  rate.stamp_ns = measured.stamp_ns;
  rate.interval_start_ns = previous_->stamp_ns;
  rate.rate_radps = (heading - previous_->heading_rad) / dt;
  rate.sigma_radps = std::hypot(measured.noise_rad, previous_->noise_rad) / dt;
  if (std::abs(rate.rate_radps) > config_.max_rate_radps) return std::nullopt;
  return rate;
}

// True once enough disagreeing frames in a row agree with each other: the walker has entered a
// corridor at another angle than 90 degrees, or the building's directions were wrong before.
bool CorridorTracker::anchor_anew(double difference) {
  const bool agrees =
      disagreeing_ > 0 && std::abs(difference - disagreement_rad_) < config_.anchor_spread_rad;
  disagreeing_ = agrees ? disagreeing_ + 1 : 1;
  if (!agrees) disagreement_rad_ = difference;
  return disagreeing_ >= config_.frames_to_anchor;
}

}  // namespace vpdr::vision
