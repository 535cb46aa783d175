#pragma once
// Which of the building's directions the heading refers to. A frame gives the heading modulo 90
// degrees; the tracker keeps it continuous through turns, unwrapped, relative to the corridor in
// which it started, and gives the turn rate between frames. Radians, counter-clockwise seen from
// above. Not thread-safe; allocates nothing.
#include <optional>

#include "core/estimates.hpp"
#include "core/time.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/frame_check.hpp"

namespace vpdr::vision {

struct TrackerConfig {
  double max_disagreement_rad = 0.35;  ///< from the turn that the gyroscope saw, else refused
  int frames_to_anchor = 8;            ///< refused frames that agree make a new direction
  double anchor_spread_rad = 0.1;      ///< they agree when their differences stay within this
  double max_rate_interval_s = 0.5;    ///< no rate between frames further apart
  double max_rate_radps = 8.0;         ///< no head turns faster: no rate beyond
};

/// The heading of one frame, modulo 90 degrees.
struct QuarterHeading {
  TimestampNs stamp_ns = 0;
  double heading_rad = 0.0;
  double noise_rad = 0.0;  ///< standard deviation of what differs from frame to frame
};

class CorridorTracker {
 public:
  explicit CorridorTracker(const TrackerConfig& config) : config_(config) {}

  /// Tells how far the body had turned at a frame (nothing where unknown), before `follow`, for
  /// every frame.
  void predict(const std::optional<GyroTurn>& turn);

  struct Followed {
    FrameOutcome outcome = FrameOutcome::kFound;  ///< or kDisagrees
    double heading_rad = 0.0;                     ///< unwrapped, relative to the first corridor
    std::optional<HeadingRate> rate;
  };
  /// Takes a frame's heading.
  Followed follow(const QuarterHeading& measured);

 private:
  [[nodiscard]] std::optional<HeadingRate> rate_to(const QuarterHeading& measured,
                                                   double heading) const;
  bool anchor_anew(double difference);

  TrackerConfig config_;
  std::optional<GyroTurn> last_turn_;
  bool predicted_by_turn_ = false;  ///< unbroken knowledge of the turn since the last heading
  std::optional<double> heading_;   ///< last heading, turned on by the gyroscope since
  double offset_rad_ = 0.0;         ///< of the followed corridor, where not a multiple of 90 deg
  int disagreeing_ = 0;
  double disagreement_rad_ = 0.0;
  struct Previous {
    TimestampNs stamp_ns;
    double heading_rad, noise_rad;
  };
  std::optional<Previous> previous_;
};

}  // namespace vpdr::vision
