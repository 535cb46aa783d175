#pragma once
// Frames of WitMotion boards (WT61, WT901 and their kin): 0x55, type, eight bytes of data, sum of
// the ten before, low byte first throughout. A set of frames belongs to one instant, in rising
// order of their types:
//
//   0x50 time    YY MM DD hh mm ss ms16    0x53 angle     not used: vpdr has its own
//   0x51 accel   x y z temperature         0x54 field     x y z temperature
//   0x52 rate    x y z temperature         0x56 pressure  Pa32 height32
//
// Acceleration and rate make one reading, so both must be whole and side by side. The sum of eight
// bits lets one damaged frame in 256 pass; what follows a frame, where it is there already, tells
// most of those: see follows_on(). Pure.
#include <string>

#include "imu_gateway/core/board_parser.hpp"

namespace vpdr::imu_gateway {

/// Full scale as set on the board.
struct WitOptions {
  double acceleration_range_g = 16.0;
  double rate_range_dps = 2000.0;
  double field_unit_ut = 0.1;  ///< microtesla in one count; the data sheets say 1 mG
};

class WitParser : public BoardParser {
 public:
  explicit WitParser(const WitOptions& options) : options_(options) {}

  void feed(std::string_view bytes, std::vector<BoardReadings>& out) override;
  void reset() override;

 private:
  enum class Look : std::uint8_t { kGood, kBad, kNeedMore };
  [[nodiscard]] Look look_at(std::size_t position) const;
  [[nodiscard]] Look follows_on(std::size_t end) const;
  void accept(std::size_t position, std::vector<BoardReadings>& out);
  void begin_set(std::size_t position);
  void emit(BoardReadings readings, std::vector<BoardReadings>& out);
  void lose_beat();
  [[nodiscard]] std::uint8_t byte(std::size_t i) const {
    return static_cast<std::uint8_t>(buffer_[i]);
  }
  [[nodiscard]] double count(std::size_t i) const;
  [[nodiscard]] Eigen::Vector3d vector_at(std::size_t data, double unit) const;

  WitOptions options_;
  std::string buffer_;          ///< at most one frame and what follows_on() wants, between calls
  bool in_step_ = false;        ///< the last frame was whole
  std::uint8_t last_type_ = 0;  ///< of the frame just before; 0: none, or damaged
  std::optional<Eigen::Vector3d> force_;    ///< of the frame just before
  double temperature_c_ = 0.0;              ///< with force_
  std::optional<TimestampNs> set_time_ns_;  ///< of the set being read
  int sets_without_time_ = 0;  ///< in a row; counts only once the board has sent a time
  bool sends_time_ = false;
};

}  // namespace vpdr::imu_gateway
