#pragma once
// Climbs and floors out of a filtered height. A climb begins where the height surely changes and
// has ended once it surely does not for a while, longer than one crosses a landing. What was
// gained by then is a number of floors. Whether it was by stairs the steps tell: there are five and
// more to a metre of stairs. Heights in m, up. Not thread-safe; allocates nothing.
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::pdr {

/// How the height changes now. A lift is whatever lifts who does not step, an escalator too.
enum class VerticalState : std::uint8_t { kLevel, kStairsUp, kStairsDown, kLiftUp, kLiftDown };

/// "level", "stairs up", "stairs down", "lift up", "lift down".
[[nodiscard]] const char* name_of(VerticalState state);

struct FloorConfig {
  double floor_height_m =
      3.2;                ///< m, from floor to floor, until the building's is learned; (1, 20)
  double settle_s = 6.0;  ///< s on the level that end a climb; landings take less; (0.5, 60)
};

/// A filtered height.
struct HeightReading {
  TimestampNs stamp_ns = 0;
  double height_m = 0.0;
  double speed_mps = 0.0;
  double climbing = 0.0;  ///< probability that the height changes
  bool walking = false;
};

/// A climb that led to another floor.
struct FloorChange {
  TimestampNs begin_ns = 0;
  TimestampNs end_ns = 0;
  double gained_m = 0.0;
  int floors = 0;  ///< down: negative
  bool by_stairs = false;
};

class FloorTracker {
 public:
  explicit FloorTracker(const FloorConfig& config = {})
      : config_(config), floor_height_m_(config.floor_height_m) {}

  void add(const HeightReading& reading);
  void add_step() { steps_ += in_climb_ ? 1 : 0; }

  [[nodiscard]] VerticalState state() const { return state_; }
  /// Above the floor of the start.
  [[nodiscard]] int floor() const { return floor_; }
  [[nodiscard]] int changes() const { return changes_; }
  [[nodiscard]] const std::optional<FloorChange>& last_change() const { return last_change_; }
  /// As configured, and as the climbs of one floor were.
  [[nodiscard]] double floor_height_m() const { return floor_height_m_; }

 private:
  void begin_climb(const HeightReading& reading);
  void settle(const HeightReading& reading);
  [[nodiscard]] VerticalState moving_state(const HeightReading& reading) const;

  FloorConfig config_;
  double floor_height_m_;
  int learned_from_ = 1;
  VerticalState state_ = VerticalState::kLevel;
  bool moving_ = false;       ///< the height changes
  bool in_climb_ = false;     ///< it does, or did on this side of a landing
  double floor_level_m_ = 0;  ///< height of the floor that was left last
  TimestampNs climb_began_ns_ = 0;
  TimestampNs calm_since_ns_ = 0;
  int steps_ = 0;  ///< of the climb
  int floor_ = 0;
  int changes_ = 0;
  std::optional<FloorChange> last_change_;
};

}  // namespace vpdr::pdr
