#include "pdr/core/height/floor_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

namespace {

/// Probabilities at which a movement begins and ends.
constexpr double kBegins = 0.8;
constexpr double kEnds = 0.3;
/// Share of a floor that is one; less may go on after a rest on a landing, or ...
constexpr double kLeastShare = 0.65;
/// ... if it is no more than this, m, is a step or a ramp on the same floor.
constexpr double kSameFloor = 0.7;
/// Steps to a metre of height that make stairs: a stair rises by 0.2 m at most.
constexpr double kStepsPerMetre = 2.0;

}  // namespace

const char* name_of(VerticalState state) {
  switch (state) {
    case VerticalState::kLevel:
      return "level";
    case VerticalState::kStairsUp:
      return "stairs up";
    case VerticalState::kStairsDown:
      return "stairs down";
    case VerticalState::kLiftUp:
      return "lift up";
    case VerticalState::kLiftDown:
      return "lift down";
  }
  return "unknown";
}

void FloorTracker::add(const HeightReading& reading) {
  if (moving_ ? reading.climbing < kEnds : reading.climbing > kBegins) {
    moving_ = !moving_;
    if (moving_ && !in_climb_) begin_climb(reading);
  }
  if (moving_ || reading.climbing >= kEnds) calm_since_ns_ = reading.stamp_ns;
  state_ = moving_ ? moving_state(reading) : VerticalState::kLevel;
  if (to_seconds(reading.stamp_ns - calm_since_ns_) >= config_.settle_s) settle(reading);
}

void FloorTracker::begin_climb(const HeightReading& reading) {
  in_climb_ = true;
  climb_began_ns_ = reading.stamp_ns;
  steps_ = 0;
}

VerticalState FloorTracker::moving_state(const HeightReading& reading) const {
  const bool up = reading.speed_mps > 0.0;
  if (reading.walking) return up ? VerticalState::kStairsUp : VerticalState::kStairsDown;
  return up ? VerticalState::kLiftUp : VerticalState::kLiftDown;
}

void FloorTracker::settle(const HeightReading& reading) {
  const double gained = reading.height_m - floor_level_m_;
  const double share = std::abs(gained) / floor_height_m_;
  if (share < kLeastShare) {
    // Slow changes of the level go with the floor; half a storey waits for the other half.
    if (std::abs(gained) < kSameFloor) floor_level_m_ = reading.height_m;
    in_climb_ = false;
    return;
  }
  const int floors = std::max(1, static_cast<int>(std::lround(share)));
  if (floors == 1) {
    ++learned_from_;
    floor_height_m_ += (std::abs(gained) - floor_height_m_) / learned_from_;
  }
  FloorChange change;
  change.begin_ns = climb_began_ns_;
  change.end_ns = calm_since_ns_;
  change.gained_m = gained;
  change.floors = gained > 0.0 ? floors : -floors;
  change.by_stairs = steps_ > kStepsPerMetre * std::abs(gained);
  last_change_ = change;
  floor_ += change.floors;
  ++changes_;
  floor_level_m_ = reading.height_m;
  in_climb_ = false;
}

}  // namespace vpdr::pdr
