#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "pdr/core/steps/step_sequence.hpp"

namespace vpdr::pdr {
namespace {

/// The step number `n` of a walk of two a second that begins at 10 s.
DetectedStep step(int n, StepStatus status = StepStatus::kConfirmed) {
  DetectedStep out;
  out.stamp_ns = to_ns(10.0 + 0.5 * n);
  out.previous_ns = to_ns(10.0 + 0.5 * (n - 1));
  out.frequency_hz = 2.0;
  out.swing_mps2 = 5.0;
  out.status = status;
  return out;
}

void take(StepSequence& sequence, const DetectedStep& step, double yaw_rad, double length_m) {
  sequence.take(step, sequence.shape(step, yaw_rad), yaw_rad, length_m);
}

TEST(StepSequence, TheFirstStepSetsOffAndTheNextDoesNot) {
  StepSequence sequence;
  EXPECT_TRUE(sequence.empty());
  EXPECT_TRUE(sequence.shape(step(0), 0.0).sets_off);
  take(sequence, step(0), 0.0, 0.4);
  EXPECT_FALSE(sequence.shape(step(1), 0.0).sets_off);
  EXPECT_EQ(sequence.shape(step(1), 0.0).frequency_hz, 2.0);
  EXPECT_EQ(sequence.shape(step(1), 0.0).swing_mps2, 5.0);
  // After a halt the one before is none of this walk.
  EXPECT_TRUE(sequence.shape(step(9), 0.0).sets_off);
}

TEST(StepSequence, OnlyTheFirstAnnouncedStepSetsOff) {
  StepSequence sequence;
  for (int n = 0; n < 4; ++n) {
    const DetectedStep announced = step(n, StepStatus::kTentative);
    EXPECT_EQ(sequence.shape(announced, 0.0).sets_off, n == 0) << "step " << n;
    take(sequence, announced, 0.0, 0.6);
  }
  for (int n = 0; n < 4; ++n) {
    EXPECT_EQ(sequence.shape(step(n), 0.0).sets_off, n == 0) << "confirmed step " << n;
    take(sequence, step(n), 0.0, 0.6);
  }
}

TEST(StepSequence, ATurnIsTheMeanOverTheStride) {
  StepSequence sequence;
  take(sequence, step(0), 3.0, 0.6);
  EXPECT_EQ(sequence.shape(step(0), 3.0).turn_rad, 0.0);
  EXPECT_NEAR(sequence.shape(step(1), 3.2).turn_rad, 0.2, 1e-12);
  take(sequence, step(1), 3.2, 0.6);
  // Across the cut at 180 degrees: 0.4 after 0.2.
  EXPECT_NEAR(sequence.shape(step(2), 3.6 - 2.0 * kPi).turn_rad, 0.3, 1e-12);
  // Forth with one leg and back with the other is none.
  EXPECT_NEAR(sequence.shape(step(2), 3.0).turn_rad, 0.0, 1e-12);
}

TEST(StepSequence, SpeedIsThatOfTheNewestStepUntilTheNextIsOverdue) {
  StepSequence sequence;
  EXPECT_EQ(sequence.speed_mps(to_ns(10.0)), 0.0);
  take(sequence, step(0), 0.0, 0.4);
  take(sequence, step(1, StepStatus::kTentative), 0.0, 0.6);
  EXPECT_DOUBLE_EQ(sequence.speed_mps(to_ns(10.6)), 1.2);
  // The confirmation of an older one does not bring its pace back.
  take(sequence, step(0), 0.0, 0.4);
  EXPECT_DOUBLE_EQ(sequence.speed_mps(to_ns(11.4)), 1.2);
  EXPECT_EQ(sequence.speed_mps(to_ns(11.6)), 0.0);
}

TEST(StepSequence, AWithdrawnStepLeavesThePaceOfTheWalkItWasAnnouncedIn) {
  StepSequence sequence;
  take(sequence, step(0, StepStatus::kTentative), 0.0, 0.6);
  sequence.withdraw();
  EXPECT_EQ(sequence.speed_mps(to_ns(10.2)), 0.0);
  take(sequence, step(0), 0.0, 0.6);
  take(sequence, step(1, StepStatus::kTentative), 0.0, 0.5);
  sequence.withdraw();
  EXPECT_DOUBLE_EQ(sequence.speed_mps(to_ns(10.6)), 1.2);
  EXPECT_EQ(sequence.speed_mps(to_ns(11.1)), 0.0);
}

TEST(StepSequence, NobodyGoesOnWithTheStepsOfABoardThatIsHandled) {
  StepSequence sequence;
  DetectedStep bounce = step(0, StepStatus::kTentative);
  bounce.probability = 0.1;
  take(sequence, bounce, 0.0, 0.6);
  EXPECT_EQ(sequence.speed_mps(to_ns(10.2)), 0.0);
}

}  // namespace
}  // namespace vpdr::pdr
