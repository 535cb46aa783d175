#pragma once
// What a step's place among the others tells of it: whether it sets off from a stand, how far it
// turns, and how fast the walker goes with it. Yaws in any frame that does not turn, rad. Not
// thread-safe; allocates nothing.
#include <optional>

#include "core/time.hpp"
#include "pdr/core/steps/detected_step.hpp"

namespace vpdr::pdr {

/// How a step was made: what its length is judged by.
struct StepShape {
  double frequency_hz = 0.0;  ///< steps per second
  double swing_mps2 = 0.0;    ///< a_max - a_min
  double on_stairs = 0.0;     ///< probability that it leads to another stair
  double turn_rad = 0.0;      ///< of the board, either way, mean over the stride
  bool sets_off = false;      ///< from a stand
  /// Of the board against the confirmed step before; none: there is none that it follows.
  std::optional<double> own_turn_rad{};
};

class StepSequence {
 public:
  /// Of a step, tentative or confirmed, that comes after those taken.
  [[nodiscard]] StepShape shape(const DetectedStep& step, double yaw_rad) const;
  /// A step, its shape and its length. A confirmed one is the one the next turns against.
  void take(const DetectedStep& step, const StepShape& shape, double yaw_rad, double length_m);
  /// What was announced is no step: whoever walked before it walks on.
  void withdraw();

  [[nodiscard]] bool empty() const { return !last_; }
  /// The latest confirmed one; none: zeros.
  [[nodiscard]] DetectedStep last() const { return last_ ? last_->step : DetectedStep{}; }
  [[nodiscard]] StepShape last_shape() const { return last_ ? last_->shape : StepShape{}; }
  [[nodiscard]] double last_yaw_rad() const { return last_ ? last_->yaw_rad : 0.0; }
  [[nodiscard]] double last_length_m() const { return last_ ? last_->length_m : 0.0; }
  /// Of the walker by the newest step, announced ones too; zero when the next one is overdue.
  [[nodiscard]] double speed_mps(TimestampNs stamp_ns) const;

 private:
  struct Taken {
    DetectedStep step;
    StepShape shape;
    double yaw_rad = 0.0;
    double length_m = 0.0;
  };
  struct Pace {
    TimestampNs stamp_ns = 0;  ///< of the newest step
    double period_s = 0.0;
    double speed_mps = 0.0;
  };
  [[nodiscard]] static Pace pace_of(const DetectedStep& step, double length_m);
  [[nodiscard]] std::optional<double> turn(const DetectedStep& step, double yaw_rad) const;

  std::optional<Taken> last_;
  Pace pace_;
};

}  // namespace vpdr::pdr
