#include "imu_gateway/core/startup_checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/axis_map.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr TimestampNs kTurnNs = 500'000'000;  ///< length of the turns that tell the axes
constexpr TimestampNs kGapNs = 100'000'000;   ///< a turn with a longer hole is no turn
constexpr double kLeastTurnRad = 0.1;
constexpr double kLargestTurnRad = 1.2;
constexpr double kSmoothS = 0.1;              ///< directions of gravity are means over about this
constexpr double kStillShare = 0.1;           ///< a force further from g is not gravity's
constexpr double kForceDirectionSigma = 0.1;  ///< a moving hand's acceleration, radians
constexpr double kFieldDirectionSigma = 0.03;

std::string number(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

/// Likely causes of a wrong length of gravity.
std::string gravity_remedy(double force) {
  if (std::abs(force - 1.0) < 0.1)
    return "the accelerometer is read in g: name its unit, or convert it";
  if (std::abs(force - 1000.0) < 100.0)
    return "the accelerometer is read in mg: name its unit, or convert it";
  for (const double factor : {0.125, 0.25, 0.5, 2.0, 4.0, 8.0}) {
    if (std::abs(force / (factor * kGravityMps2) - 1.0) < 0.06) {
      return "the accelerometer's full scale is set otherwise than it is converted: check the "
             "range";
    }
  }
  return "run vpdr calibrate imu; if that does not help, check the accelerometer's unit and range";
}

}  // namespace

const char* name_of(StartupFault fault) {
  switch (fault) {
    case StartupFault::kGravity:
      return "gravity";
    case StartupFault::kRatesInDegrees:
      return "rates_in_degrees";
    case StartupFault::kGyroscopeAxes:
      return "gyroscope_axes";
    case StartupFault::kMagnetometerAxes:
      return "magnetometer_axes";
    case StartupFault::kField:
      return "field";
    case StartupFault::kSampleRate:
      return "sample_rate";
  }
  return "";
}

void StartupChecks::add(StartupFault fault, const std::string& what, const std::string& remedy) {
  if (is_found(fault)) return;
  found_[static_cast<std::size_t>(fault)] = true;
  findings_.push_back({fault, what, remedy});
}

void StartupChecks::see(const ImuSample& sample) {
  if (second_.count == 0) second_.begin_ns = sample.stamp_ns;
  const double force = sample.specific_force_mps2.norm();
  second_.force += force;
  second_.force_squares += force * force;
  ++second_.count;
  if (sample.angular_velocity_radps.norm() > config_.degrees_radps) ++second_.fast;
  if (last_) {
    const TimestampNs step_ns = sample.stamp_ns - last_->stamp_ns;
    const double step_s = to_seconds(step_ns);
    const bool hole = step_ns > kGapNs || step_ns <= 0;
    smooth_force_ += (hole ? 1.0 : std::min(1.0, step_s / kSmoothS)) *
                     (sample.specific_force_mps2 - smooth_force_);
    const Eigen::Vector3d turn =
        0.5 * step_s * (sample.angular_velocity_radps + last_->angular_velocity_radps);
    for (Turns* turns : {&force_turns_, &field_turns_}) {
      turns->turn_rad += turn;
      if (hole) turns->direction.reset();
    }
  } else {
    smooth_force_ = sample.specific_force_mps2;
  }
  last_ = sample;
  if (sample.has_angular_velocity) {
    const bool still = std::abs(smooth_force_.norm() / kGravityMps2 - 1.0) < kStillShare;
    if (still) {
      watch_turns(force_turns_, smooth_force_.normalized(), sample.stamp_ns,
                  StartupFault::kGyroscopeAxes, kForceDirectionSigma);
    } else {
      force_turns_.direction.reset();
    }
  }
  if (sample.stamp_ns - second_.begin_ns >= kNsPerSecond) end_of_second();
}

void StartupChecks::end_of_second() {
  const double count = second_.count;
  const double mean = second_.force / count;
  const double sigma = std::sqrt(std::max(0.0, second_.force_squares / count - mean * mean));
  judge_gravity(mean, sigma);
  judge_mean_force(mean);
  judge_degrees();
  judge_rate();
  second_ = {};
}

void StartupChecks::judge_gravity(double mean, double sigma) {
  // What is still in other units must be still in them too.
  if (rests_ >= config_.rest_seconds ||
      sigma > config_.rest_sigma_mps2 * std::max(0.05, mean / kGravityMps2)) {
    return;
  }
  rest_force_ += mean / config_.rest_seconds;
  if (++rests_ < config_.rest_seconds) return;
  if (std::abs(rest_force_ / kGravityMps2 - 1.0) <= config_.gravity_tolerance) return;
  add(StartupFault::kGravity,
      "gravity reads " + number(rest_force_, 2) + " m/s^2 at rest, not 9.8 within " +
          number(100.0 * config_.gravity_tolerance, 0) + " %",
      gravity_remedy(rest_force_));
}

/// Whoever moves feels gravity on the average, also one who never rests.
void StartupChecks::judge_mean_force(double mean) {
  if (moving_ >= config_.moving_seconds) return;
  moving_force_ += mean / config_.moving_seconds;
  if (++moving_ < config_.moving_seconds) return;
  const double share = moving_force_ / kGravityMps2;
  if (share > config_.min_moving_share && share < config_.max_moving_share) return;
  add(StartupFault::kGravity,
      "the specific force reads " + number(moving_force_, 2) + " m/s^2 on the average of " +
          std::to_string(config_.moving_seconds) + " s, not about 9.8",
      gravity_remedy(moving_force_));
}

void StartupChecks::judge_degrees() {
  fast_seconds_ = 2 * second_.fast > second_.count ? fast_seconds_ + 1 : 0;
  if (fast_seconds_ < config_.degrees_seconds) return;
  add(StartupFault::kRatesInDegrees,
      "the gyroscope reads more than " + number(config_.degrees_radps, 0) + " rad/s for seconds",
      "its rates are in degrees: name the unit dps, or convert them");
}

void StartupChecks::judge_rate() {
  if (config_.expected_rate_hz <= 0.0 || seconds_ >= config_.rate_seconds) return;
  ++seconds_;
  samples_ += second_.count - 1;
  sampled_s_ += to_seconds(last_->stamp_ns - second_.begin_ns);
  if (seconds_ < config_.rate_seconds) return;
  const double rate = samples_ / sampled_s_;
  if (std::abs(rate / config_.expected_rate_hz - 1.0) <= config_.rate_tolerance) return;
  add(StartupFault::kSampleRate,
      "the board sends " + number(rate, 1) + " samples/s, not " +
          number(config_.expected_rate_hz, 1),
      rate < config_.expected_rate_hz
          ? "is the baud rate enough for it, and the board set to this rate?"
          : "set the board to this rate, or imu_gateway.expected_rate_hz to its own");
}

void StartupChecks::watch_turns(Turns& turns, const Eigen::Vector3d& direction,
                                TimestampNs stamp_ns, StartupFault fault, double sigma) {
  if (turns.judged) return;
  if (turns.direction && stamp_ns - turns.begin_ns < kTurnNs) return;
  if (turns.direction) {
    const double angle = turns.turn_rad.norm();
    if (angle > kLeastTurnRad && angle < kLargestTurnRad) {
      turns.alignment.add(turns.turn_rad * (2.0 * std::tan(0.5 * angle) / angle), *turns.direction,
                          direction, sigma);
      judge_axes(turns, fault);
    }
  }
  turns.direction = direction;
  turns.begin_ns = stamp_ns;
  turns.turn_rad.setZero();
}

void StartupChecks::judge_axes(Turns& turns, StartupFault fault) {
  const auto solution = turns.alignment.solve();
  if (!solution || solution->worst_sigma > config_.max_axis_sigma) return;
  const Eigen::Matrix3d& found = solution->direction_from_gyro;
  const Eigen::Matrix3d map = nearest_axis_map(found);
  if ((found - map).cwiseAbs().maxCoeff() > config_.max_axis_error) return;
  turns.judged = true;
  if (map.isIdentity()) return;
  const bool mirrored = map.determinant() < 0.0;
  const std::string sensor =
      fault == StartupFault::kGyroscopeAxes ? "accelerometer" : "magnetometer";
  add(fault,
      "while the board turns, gyroscope and " + sensor + " see different axes (" +
          axis_map_name(map) + (mirrored ? "): one of them is left-handed" : ")"),
      fault == StartupFault::kGyroscopeAxes
          ? "set imu_gateway.serial.gyroscope_axes to " + axis_map_name(map) +
                ", or run vpdr calibrate imu with turns between the rests"
          : "run vpdr calibrate mag, which finds the axes of the magnetometer");
}

void StartupChecks::see(const MagSample& sample) {
  if (last_ && last_->has_angular_velocity && !sample.field_ut.isZero()) {
    watch_turns(field_turns_, sample.field_ut.normalized(), sample.stamp_ns,
                StartupFault::kMagnetometerAxes, kFieldDirectionSigma);
  }
  if (field_count_ < 0.0) return;  // judged
  if (field_count_ == 0.0) field_begin_ns_ = sample.stamp_ns;
  field_sum_ += sample.field_ut.norm();
  field_count_ += 1.0;
  if (sample.stamp_ns - field_begin_ns_ < config_.field_seconds * kNsPerSecond) return;
  const double mean = field_sum_ / field_count_;
  field_count_ = -1.0;
  if (mean >= config_.min_field_ut && mean <= config_.max_field_ut) return;
  add(StartupFault::kField,
      "the magnetic field reads " + number(mean, 2) + " uT; the Earth's is 22 to 67",
      mean < config_.min_field_ut
          ? "its unit is gauss or tesla: name it, or check the magnetometer's range"
          : "the board's own magnetism: run vpdr calibrate mag; or its unit is mG or counts");
}

}  // namespace vpdr::imu_gateway
