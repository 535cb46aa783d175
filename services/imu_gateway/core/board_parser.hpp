#pragma once
// What every board protocol comes down to: bytes in, readings out.
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace vpdr::imu_gateway {

/// What one frame or line held, in SI units and board axes; the field in microtesla.
struct BoardReadings {
  std::optional<TimestampNs> board_stamp_ns;  ///< the board's own clock; absent where it has none
  TimestampNs clock_wraps_at_ns = 0;          ///< the board's clock starts again here; 0: never
  std::optional<Eigen::Vector3d> specific_force_mps2;
  std::optional<Eigen::Vector3d> angular_velocity_radps;
  std::optional<Eigen::Vector3d> field_ut;
  std::optional<double> pressure_pa;
  std::optional<double> temperature_c;
};

/// What a parser met since its start.
struct ParserCounts {
  std::uint64_t malformed = 0;       ///< damaged frames, lines that cannot be read
  std::uint64_t unknown_layout = 0;  ///< whole, but of no kind that is known
  std::uint64_t overlong = 0;        ///< dropped for their length
  std::uint64_t incomplete = 0;      ///< whole frames whose other half was damaged
  std::uint64_t lost = 0;            ///< missing by the board's own sequence numbers
  std::uint64_t duplicates = 0;      ///< the same frame again, by its sequence number
};

/// Streaming parser of one board: takes bytes in pieces of any size, keeps a bounded number of
/// them, finds the beat again within two frames of a damage. Pure; belongs to one thread.
class BoardParser {
 public:
  virtual ~BoardParser() = default;

  /// Appends to `out` what becomes whole with `bytes`.
  virtual void feed(std::string_view bytes, std::vector<BoardReadings>& out) = 0;
  /// Forgets a half-read frame, as after a reconnection.
  virtual void reset() = 0;
  [[nodiscard]] const ParserCounts& counts() const { return counts_; }
  /// The beginning of the latest line that could not be read; empty where the board sends no lines.
  [[nodiscard]] virtual std::string_view last_refused() const { return {}; }

 protected:
  ParserCounts counts_;
};

}  // namespace vpdr::imu_gateway
