#include "imu_gateway/core/wit_parser.hpp"

#include <numeric>

#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr std::size_t kFrame = 11;
constexpr std::size_t kData = 2;  ///< first data byte
constexpr std::uint8_t kHeader = 0x55;
constexpr std::uint8_t kTime = 0x50;
constexpr std::uint8_t kAcceleration = 0x51;
constexpr std::uint8_t kRate = 0x52;
constexpr std::uint8_t kField = 0x54;
constexpr std::uint8_t kPressure = 0x56;
constexpr std::uint8_t kLastType = 0x5F;
/// A board that sends times and then none for so many sets was set anew.
constexpr int kSetsToForgetTime = 8;

/// Since 2000; later ones would not leave room for differences of stamps in 64 bits.
constexpr int kYearsKnown = 43;

bool is_type(std::uint8_t byte) { return byte >= kTime && byte <= kLastType; }

/// Days since 1970-01-01 of a date of the Gregorian calendar (counted from March, era by era).
std::int64_t days_from_civil(std::int64_t year, std::int64_t month, std::int64_t day) {
  const std::int64_t y = month <= 2 ? year - 1 : year;
  const std::int64_t era = y / 400;
  const std::int64_t year_of_era = y - era * 400;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
         719468;
}

}  // namespace

double WitParser::count(std::size_t i) const {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(byte(i) | (byte(i + 1) << 8)));
}

Eigen::Vector3d WitParser::vector_at(std::size_t data, double unit) const {
  return unit * Eigen::Vector3d(count(data), count(data + 2), count(data + 4));
}

void WitParser::reset() {
  buffer_.clear();
  in_step_ = false;
  lose_beat();
}

void WitParser::lose_beat() {
  if (in_step_) ++counts_.malformed;
  in_step_ = false;
  last_type_ = 0;
  force_.reset();
  set_time_ns_.reset();
}

void WitParser::feed(std::string_view bytes, std::vector<BoardReadings>& out) {
  buffer_.append(bytes);
  std::size_t position = 0;
  for (Look look = look_at(position); look != Look::kNeedMore; look = look_at(position)) {
    if (look == Look::kBad) {
      lose_beat();
      ++position;
      continue;
    }
    in_step_ = true;
    accept(position, out);
    position += kFrame;
  }
  buffer_.erase(0, position);
}

WitParser::Look WitParser::look_at(std::size_t position) const {
  const std::size_t left = buffer_.size() - position;
  if (left > 0 && byte(position) != kHeader) return Look::kBad;
  if (left > 1 && !is_type(byte(position + 1))) return Look::kBad;
  if (left < kFrame) return Look::kNeedMore;
  const std::size_t last = position + kFrame - 1;
  unsigned sum = 0;
  for (std::size_t i = position; i < last; ++i) sum += byte(i);
  if ((sum & 0xFFU) != byte(last)) return Look::kBad;
  return follows_on(last);
}

/// A frame that lost a byte has the next frame's 0x55 for its sum, one that got a byte twice has
/// its sum behind it. Neither may pass by chance.
WitParser::Look WitParser::follows_on(std::size_t last) const {
  const std::size_t left = buffer_.size() - last;
  if (byte(last) == kHeader) {
    if (left < 2) return Look::kNeedMore;
    if (is_type(byte(last + 1)) && byte(last + 1) != kHeader) return Look::kBad;
  }
  if (left < 2 || byte(last + 1) == kHeader) return Look::kGood;
  if (left < 4) return Look::kNeedMore;
  const bool shifted = byte(last + 2) == kHeader && is_type(byte(last + 3));
  return shifted ? Look::kBad : Look::kGood;
}

void WitParser::begin_set(std::size_t position) {
  force_.reset();
  set_time_ns_.reset();
  const std::size_t data = position + kData;
  if (byte(position + 1) == kTime) {
    const double ms = count(data + 6);
    const bool valid = byte(data) < kYearsKnown && byte(data + 1) >= 1 && byte(data + 1) <= 12 &&
                       byte(data + 3) < 24 && byte(data + 4) < 60 && byte(data + 5) < 60 &&
                       ms >= 0.0 && ms < 1000.0;
    if (!valid) return;
    const std::int64_t days = days_from_civil(2000 + byte(data), byte(data + 1), byte(data + 2));
    const std::int64_t seconds =
        ((days * 24 + byte(data + 3)) * 60 + byte(data + 4)) * 60 + byte(data + 5);
    set_time_ns_ = seconds * kNsPerSecond + to_ns(ms * 1e-3);
    sends_time_ = true;
    sets_without_time_ = 0;
  } else if (sends_time_ && ++sets_without_time_ >= kSetsToForgetTime) {
    sends_time_ = false;
  }
}

void WitParser::emit(BoardReadings readings, std::vector<BoardReadings>& out) {
  if (sends_time_ && !set_time_ns_) {
    ++counts_.incomplete;
    return;
  }
  readings.board_stamp_ns = set_time_ns_;
  out.push_back(readings);
}

void WitParser::accept(std::size_t position, std::vector<BoardReadings>& out) {
  const std::uint8_t type = byte(position + 1);
  const std::size_t data = position + kData;
  const bool begins = type == kTime || (type == kAcceleration && last_type_ != kTime);
  if (begins) begin_set(position);
  last_type_ = type;
  if (type == kAcceleration) {
    force_ = vector_at(data, options_.acceleration_range_g / 32768.0 * kGravityMps2);
    temperature_c_ = count(data + 6) * 0.01;
    return;
  }
  BoardReadings readings;
  if (type == kRate) {
    if (force_) {
      readings.specific_force_mps2 = force_;
      readings.angular_velocity_radps =
          vector_at(data, options_.rate_range_dps / 32768.0 * kPi / 180.0);
      readings.temperature_c = temperature_c_;
      emit(readings, out);
    } else {
      ++counts_.incomplete;
    }
  }
  force_.reset();
  if (type == kField) {
    readings.field_ut = vector_at(data, options_.field_unit_ut);
    emit(readings, out);
  }
  if (type == kPressure) {
    const std::uint32_t pascal = byte(data) | (byte(data + 1) << 8) | (byte(data + 2) << 16) |
                                 (static_cast<std::uint32_t>(byte(data + 3)) << 24);
    readings.pressure_pa = pascal;
    emit(readings, out);
  }
}

}  // namespace vpdr::imu_gateway
