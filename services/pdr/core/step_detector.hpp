#pragma once
// Steps from the norm of specific force (S3.1, S1.1): resampled to a fixed rate, freed of its slow
// mean (zero drift), low-passed by a Butterworth filter, peaks at least a minimum interval apart
// and above a threshold that follows the walker. The norm does not change with the way the board is
// held. A step's stamp is the instant of its peak, the filter's delay taken away.
//
// The paper's minimum interval of 0.75 s cannot give the 1.53 and 1.71 steps/s of its own table; it
// is configurable and shorter. Peaks are steps when they belong to a walk: strides (two steps, so
// that a limp or a board on one leg does no harm) of even length whose signal resembles that of the
// stride before, while the board does not spin. The first peaks of a walk are held back until that
// is so and then given one by one; from there on each step is given as soon as its peak is over.
// SI. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "core/time.hpp"
#include "pdr/core/butterworth.hpp"

namespace vpdr::pdr {

struct StepConfig {
  double cutoff_hz = 3.0;            ///< Hz, Butterworth low-pass; (0.5, 20)
  int filter_order = 4;              ///< 2 or 4
  double drift_time_s = 1.0;         ///< s, over which the slow mean follows; (0.1, 60)
  double min_interval_s = 0.3;       ///< s, between two steps; (0.1, 2)
  double max_interval_s = 1.5;       ///< s, a longer pause ends the walk; (0.3, 5)
  double threshold_mps2 = 0.5;       ///< m/s^2, least height of a peak; (0, 20)
  double threshold_share = 0.4;      ///< of the recent peaks' height; (0, 1)
  int confirming_steps = 4;          ///< even peaks that make a walk; 4 to 8
  double evenness = 0.15;            ///< largest relative change from stride to stride; (0.02, 2)
  double resemblance = 0.7;          ///< least correlation of a stride with the one before; (-1, 1)
  double lasting_resemblance = 0.2;  ///< the same while a walk goes on; (-1, 1)
  double longest_stride_s = 1.8;     ///< s, of a walk that begins; (0.6, 6)
  double largest_rate_radps = 4.5;   ///< rad/s, r.m.s. over a second: faster is no walk; (0.5, 50)
  double gap_s = 0.5;                ///< s, a longer silence ends the walk; (0.05, 10)
};

struct DetectedStep {
  TimestampNs stamp_ns = 0;
  TimestampNs previous_ns = 0;  ///< stamp of the step before, or one period before
  double frequency_hz = 0.0;    ///< over the last strides
  double swing_mps2 = 0.0;      ///< a_max - a_min over the step (S1.12)
};

class StepDetector {
 public:
  explicit StepDetector(const StepConfig& config = {});

  /// Specific force and angular velocity (zero where unknown), any axes. Stamps increase.
  void add(TimestampNs stamp_ns, const Eigen::Vector3d& specific_force_mps2,
           const Eigen::Vector3d& angular_velocity_radps);
  /// The oldest step that was not taken yet.
  std::optional<DetectedStep> take();

  /// True from the confirmation of a walk until its end.
  [[nodiscard]] bool walking() const { return walking_; }
  /// Peaks held back: steps, if they turn out to belong to a walk.
  [[nodiscard]] std::size_t held_back() const { return waiting_count_; }

 private:
  static constexpr TimestampNs kGridNs = 20'000'000;  ///< 50 Hz
  static constexpr std::size_t kHistory = 256;        ///< 5 s of it
  static constexpr std::size_t kQueue = 16;

  struct Peak {
    TimestampNs stamp_ns = 0;
    double height = 0.0;
    double swing = 0.0;
  };

  void restart(TimestampNs stamp_ns, double norm);
  void add_grid_value(TimestampNs stamp_ns, double norm);
  void consider_peak(TimestampNs stamp_ns);
  void accept(const Peak& peak);
  [[nodiscard]] bool goes_on(const Peak& peak) const;
  [[nodiscard]] bool begins() const;
  [[nodiscard]] double resemblance(double stride_s) const;
  void confirm(std::size_t first);
  void emit(const Peak& peak);
  void end_walk();
  [[nodiscard]] double history(std::size_t age) const {
    return history_[(history_next_ + kHistory - 1 - age) % kHistory];
  }

  StepConfig config_;
  ButterworthLowPass low_pass_;
  double mean_ = 0.0;
  double mean_age_s_ = 0.0;
  double rate_variance_ = 0.0;

  bool started_ = false;
  TimestampNs last_stamp_ = 0;
  double last_norm_ = 0.0;
  TimestampNs next_grid_ = 0;
  double cell_sum_ = 0.0;  ///< integral of the norm over the current grid cell
  double cell_s_ = 0.0;

  std::array<double, kHistory> history_{};  ///< filtered values
  std::size_t history_next_ = 0;
  std::size_t history_count_ = 0;
  double valley_ = 0.0;
  double typical_height_ = 0.0;

  std::array<Peak, 8> waiting_{};  ///< accepted peaks that are no confirmed steps yet
  std::size_t waiting_count_ = 0;
  std::array<TimestampNs, 5> given_{};  ///< stamps of the latest steps of this walk, newest first
  std::size_t given_count_ = 0;
  std::optional<TimestampNs> last_peak_;
  bool walking_ = false;

  std::array<DetectedStep, kQueue> queue_{};
  std::size_t queue_begin_ = 0;
  std::size_t queue_count_ = 0;
};

}  // namespace vpdr::pdr
