#pragma once
// What a step detector gives: steps, each tentative at first where it may still prove to be none.
#include <array>
#include <cstddef>
#include <optional>

#include "core/estimates.hpp"
#include "core/time.hpp"

namespace vpdr::pdr {

/// One word about one step. The stamp is the step's identity: a tentative step is followed by
/// exactly one confirmation or withdrawal with the same stamp.
struct DetectedStep {
  TimestampNs stamp_ns = 0;     ///< of the peak of the specific force
  TimestampNs previous_ns = 0;  ///< stamp of the step before, or one period before
  double frequency_hz = 0.0;    ///< over the last strides
  double swing_mps2 = 0.0;      ///< a_max - a_min over the step (S1.12)
  StepStatus status = StepStatus::kConfirmed;
  double probability = 1.0;  ///< that this is a step
};

/// First in, first out; takes no memory after construction. Nobody takes: the newest are lost.
class StepQueue {
 public:
  void push(const DetectedStep& step) {
    if (count_ == steps_.size()) return;
    steps_[(begin_ + count_) % steps_.size()] = step;
    ++count_;
  }
  std::optional<DetectedStep> take() {
    if (count_ == 0) return std::nullopt;
    const DetectedStep step = steps_[begin_];
    begin_ = (begin_ + 1) % steps_.size();
    --count_;
    return step;
  }

 private:
  std::array<DetectedStep, 64> steps_{};
  std::size_t begin_ = 0;
  std::size_t count_ = 0;
};

}  // namespace vpdr::pdr
