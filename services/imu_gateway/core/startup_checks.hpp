#pragma once
// What users get wrong with a new board, told by its own samples: each mistake once, by its likely
// cause. Samples in body axes, after calibration. Pure; allocates nothing but for the texts of what
// it finds; for one thread.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration/rate_alignment.hpp"
#include "core/samples.hpp"

namespace vpdr::imu_gateway {

struct StartupCheckConfig {
  double gravity_tolerance = 0.05;  ///< share
  double rest_sigma_mps2 = 0.3;     ///< a second with less scatter is a rest
  int rest_seconds = 3;             ///< so many rests are looked at
  int moving_seconds = 10;          ///< over which the mean force is taken, at rest or not
  double min_moving_share = 0.5;    ///< of g that it is at least
  double max_moving_share = 2.5;    ///< and at most, running
  double degrees_radps = 12.0;      ///< nobody turns faster than this
  int degrees_seconds = 3;          ///< for so long
  double min_field_ut = 10.0;       ///< the Earth's is 22 to 67; steel nearby has some room
  double max_field_ut = 200.0;
  int field_seconds = 5;
  double expected_rate_hz = 0.0;  ///< 0: any
  double rate_tolerance = 0.1;    ///< share
  int rate_seconds = 5;
  double max_axis_sigma = 0.12;  ///< how well the turns must tell the axes
  double max_axis_error = 0.35;  ///< and how near to a clean map of axes
};

enum class StartupFault : std::uint8_t {
  kGravity,
  kRatesInDegrees,
  kGyroscopeAxes,
  kMagnetometerAxes,
  kField,
  kSampleRate,
};
inline constexpr std::size_t kStartupFaults = 6;

/// "gravity", "rates_in_degrees", "gyroscope_axes", "magnetometer_axes", "field", "sample_rate".
const char* name_of(StartupFault fault);

struct StartupFinding {
  StartupFault fault = StartupFault::kGravity;
  std::string what;    ///< what is measured, and what it should be
  std::string remedy;  ///< the likely cause and what to do
};

class StartupChecks {
 public:
  explicit StartupChecks(const StartupCheckConfig& config = {}) : config_(config) {}

  void see(const ImuSample& sample);
  void see(const MagSample& sample);

  /// All found so far, each kind at most once.
  [[nodiscard]] const std::vector<StartupFinding>& findings() const { return findings_; }

 private:
  /// Sums over a second of samples.
  struct Second {
    TimestampNs begin_ns = 0;
    int count = 0;
    double force = 0.0;
    double force_squares = 0.0;
    int fast = 0;
  };
  /// Direction and the turn since then, for one sensor's axes.
  struct Turns {
    calibration::RateAlignment alignment;
    std::optional<Eigen::Vector3d> direction;
    Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
    TimestampNs begin_ns = 0;
    bool judged = false;
  };

  void end_of_second();
  void judge_gravity(double mean, double sigma);
  void judge_mean_force(double mean);
  void judge_degrees();
  void judge_rate();
  void watch_turns(Turns& turns, const Eigen::Vector3d& direction, TimestampNs stamp_ns,
                   StartupFault fault, double sigma);
  void judge_axes(Turns& turns, StartupFault fault);
  void add(StartupFault fault, const std::string& what, const std::string& remedy);
  [[nodiscard]] bool is_found(StartupFault fault) const {
    return found_[static_cast<std::size_t>(fault)];
  }

  StartupCheckConfig config_;
  std::vector<StartupFinding> findings_;
  std::array<bool, kStartupFaults> found_{};
  Second second_;
  int rests_ = 0;
  double rest_force_ = 0.0;
  int moving_ = 0;
  double moving_force_ = 0.0;
  int fast_seconds_ = 0;
  int seconds_ = 0;
  double samples_ = 0.0;
  double sampled_s_ = 0.0;
  std::optional<ImuSample> last_;
  Eigen::Vector3d smooth_force_ = Eigen::Vector3d::Zero();
  Turns force_turns_;
  Turns field_turns_;
  TimestampNs field_begin_ns_ = 0;
  double field_sum_ = 0.0;
  double field_count_ = 0.0;
};

}  // namespace vpdr::imu_gateway
