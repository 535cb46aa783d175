#pragma once
// Steps that belong to a walk, on top of S3.1's peaks. A threshold follows the walker; peaks are
// steps when they come in strides (two steps, so that a limp or a board on one leg does no harm)
// of even length whose signal resembles that of the stride before, while the board neither spins
// nor tilts: whoever walks may swing it, but from stride to stride it hangs as before. A step's
// stamp is the instant of its peak, the filter's delay taken away.
//
// A limb that swings may hide every second step, or one now and then: peaks a stride apart, each
// stride like the one before, are two steps each.
//
// On the trunk there is no handling, so that peaks in a row do. There the weight's going from leg
// to leg is the second evidence: it finds the short, slow and turning steps that hardly bounce, and
// tells weak bounces that are steps from those that are none.
//
// Each peak is announced at once as a tentative step with its probability. The first ones of a walk
// are confirmed together when the walk is known, from there on each step as soon as its peak is
// over; peaks that prove to be none are withdrawn within 4.5 s.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pdr/core/steps/detected_step.hpp"
#include "pdr/core/steps/drift_free_low_pass.hpp"
#include "pdr/core/steps/step_signal.hpp"
#include "pdr/core/steps/weight_transfer.hpp"

namespace vpdr::pdr {

class GaitStepDetector {
 public:
  GaitStepDetector(const StepConfig& config, bool on_trunk);

  /// The signal was interrupted.
  void restart(StepQueue& steps);
  void add(const SignalValue& value, StepQueue& steps);
  /// True from the confirmation of a walk until its end.
  [[nodiscard]] bool walking() const { return walking_; }
  /// Duration of the latest stride of the walk under way, s.
  [[nodiscard]] std::optional<double> stride_s() const;

 private:
  static constexpr std::size_t kHistory = 256;  ///< 5 s
  static constexpr std::size_t kStrides = 4;    ///< even ones that make a walk
  /// How much more turning a walk that goes on may show than one that begins.
  static constexpr double kLastingPatience = 1.5;

  struct Peak {
    TimestampNs stamp_ns = 0;
    double height = 0.0;
    double swing = 0.0;
    bool announced = false;
  };
  /// A weak bounce or the weight's going over; announced, it waits for the other or a firm bounce.
  struct Hint {
    Peak peak;
    bool transfer = false;
  };

  /// Of bounces: no step fits between the latest two; they are as far apart as the two before.
  enum class Rhythm : std::uint8_t { kNone, kOneStep, kEven };

  [[nodiscard]] std::size_t confirming() const {
    return static_cast<std::size_t>(on_trunk_ ? config_.confirming_on_trunk
                                              : config_.confirming_steps);
  }
  void consider_peak(const SignalValue& value, StepQueue& steps);
  Rhythm take_interval(TimestampNs stamp_ns);
  void consider_bounce(const Peak& peak, StepQueue& steps);
  void consider_transfer(const SignalValue& value, StepQueue& steps);
  void take_transfer(TimestampNs stamp_ns, StepQueue& steps);
  void wait_for_more(const Hint& hint, StepQueue& steps);
  void settle_hint(StepQueue& steps);
  void drop_hint(StepQueue& steps);
  [[nodiscard]] bool with_hint(TimestampNs stamp_ns) const;
  [[nodiscard]] bool on_one_leg(TimestampNs stamp_ns) const;
  [[nodiscard]] bool bounced() const;
  [[nodiscard]] bool too_soon(TimestampNs stamp_ns) const;
  void accept(const Peak& peak, StepQueue& steps);
  [[nodiscard]] bool goes_on(const Peak& peak) const;
  [[nodiscard]] bool begins() const;
  [[nodiscard]] bool begins_by_strides() const;
  [[nodiscard]] bool misses_one(const Peak& peak) const;
  void fill_in(std::size_t place);
  [[nodiscard]] double resemblance(double stride_s) const;
  [[nodiscard]] double tilt_rad(double stride_s) const;
  [[nodiscard]] bool handled(double patience) const;
  [[nodiscard]] double probability(std::size_t before) const;
  void announce(Peak& peak, std::size_t before, StepQueue& steps) const;
  void confirm(std::size_t first, StepQueue& steps);
  void confirm(const Peak& peak, StepQueue& steps);
  [[nodiscard]] double frequency_hz() const;
  static void withdraw(const Peak& peak, StepQueue& steps);
  void withdraw(std::size_t count, StepQueue& steps);
  void end_walk(StepQueue& steps);
  [[nodiscard]] std::size_t place(std::size_t age) const {
    return (history_next_ + kHistory - 1 - age) % kHistory;
  }
  [[nodiscard]] double history(std::size_t age) const { return history_[place(age)]; }

  StepConfig config_;
  bool on_trunk_;
  DriftFreeLowPass filter_;
  std::array<double, kHistory> history_{};  ///< filtered values
  std::array<Eigen::Vector3d, kHistory> ups_{};
  std::size_t history_next_ = 0;
  std::size_t history_count_ = 0;
  double valley_ = 0.0;  ///< least and largest filtered value since the last step
  double crest_ = 0.0;
  double rate_radps_ = 0.0;
  double typical_height_ = 0.0;
  double typical_swing_ = 0.0;

  std::array<Peak, 8> waiting_{};  ///< accepted peaks that are no confirmed steps yet
  std::size_t waiting_count_ = 0;
  std::array<TimestampNs, 5> given_{};  ///< stamps of the latest steps of this walk, newest first
  std::size_t given_count_ = 0;
  std::optional<TimestampNs> last_peak_;

  // On the trunk.
  WeightTransfer transfer_;
  std::optional<TimestampNs> last_transfer_;
  std::optional<TimestampNs> last_bounce_;
  double bounce_interval_s_ = 0.0;
  std::optional<Hint> hint_;
  bool walking_ = false;
};

}  // namespace vpdr::pdr
