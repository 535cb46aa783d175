#pragma once
// Frames as they come: only the newest one is kept; an older one that nobody took is dropped and
// counted, never queued.
#include <cstdint>
#include <optional>
#include <stop_token>

#include "vision/source/frame_source.hpp"

namespace vpdr::vision {

struct LiveHealth {
  bool connected = false;
  std::uint64_t frames = 0;         ///< that came
  std::uint64_t dropped = 0;        ///< replaced by a newer one before anybody took them
  std::uint64_t reconnections = 0;  ///< after the first opening
};

/// take() belongs to one thread; health() to any.
class LiveFrames {
 public:
  virtual ~LiveFrames() = default;
  /// The newest frame not taken yet; waits for one. Nothing when asked to stop.
  virtual std::optional<Frame> take(const std::stop_token& stop) = 0;
  [[nodiscard]] virtual LiveHealth health() const = 0;
};

}  // namespace vpdr::vision
