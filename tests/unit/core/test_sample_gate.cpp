#include <gtest/gtest.h>

#include <limits>

#include "core/sample_gate.hpp"

namespace vpdr {
namespace {

ImuSample at(TimestampNs stamp_ns) {
  ImuSample s;
  s.stamp_ns = stamp_ns;
  s.specific_force_mps2 = {0.0, 0.0, kGravityMps2};
  return s;
}

TEST(SampleGate, PassesAnOrderlyStream) {
  SampleGate gate;
  for (TimestampNs t : {10, 20, 30}) EXPECT_EQ(gate.check(at(t)), Refusal::kNone);
  EXPECT_EQ(gate.accepted(), 3U);
  EXPECT_EQ(gate.refused(), 0U);
}

TEST(SampleGate, RefusesAndCountsEachFault) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(100)), Refusal::kNone);
  ImuSample nan = at(110);
  nan.angular_velocity_radps.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gate.check(nan), Refusal::kNonFinite);
  ImuSample far = at(110);
  far.specific_force_mps2.x() = 1e6;
  EXPECT_EQ(gate.check(far), Refusal::kOutOfRange);
  EXPECT_EQ(gate.check(at(100)), Refusal::kDuplicate);
  EXPECT_EQ(gate.check(at(90)), Refusal::kBackwardInTime);
  EXPECT_EQ(gate.check(at(110)), Refusal::kNone);
  EXPECT_EQ(gate.refused(), 4U);
  EXPECT_EQ(gate.refused(Refusal::kDuplicate), 1U);
}

constexpr TimestampNs kMs = 1'000'000;

TEST(SampleGate, ASpikeCostsOneSampleAndABlowCostsOneToo) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(10 * kMs)), Refusal::kNone);
  ImuSample spike = at(20 * kMs);
  spike.angular_velocity_radps.y() = 30.0;
  EXPECT_EQ(gate.check(spike), Refusal::kOutOfRange);
  EXPECT_EQ(gate.check(at(30 * kMs)), Refusal::kNone);
  for (const TimestampNs t : {40, 50, 60}) {
    ImuSample blow = at(t * kMs);
    blow.specific_force_mps2.z() = 120.0;
    EXPECT_EQ(gate.check(blow), t == 40 ? Refusal::kOutOfRange : Refusal::kNone);
  }
  // After a silence anything may be.
  EXPECT_EQ(gate.check(at(300 * kMs)), Refusal::kNone);
}

TEST(SampleGate, AReadingIsNotComparedWithOneThatWasRefused) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(10 * kMs)), Refusal::kNone);
  ImuSample wrong = at(1'000'000'000 * kMs);
  wrong.angular_velocity_radps.y() = 30.0;
  EXPECT_EQ(gate.check(wrong), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(20 * kMs)), Refusal::kNone);
  // Nor do two wrong ones bear each other out across a good one.
  ImuSample spike = at(30 * kMs);
  spike.angular_velocity_radps.y() = 30.0;
  EXPECT_EQ(gate.check(spike), Refusal::kOutOfRange);
  EXPECT_EQ(gate.check(at(40 * kMs)), Refusal::kNone);
  spike.stamp_ns = 50 * kMs;
  EXPECT_EQ(gate.check(spike), Refusal::kOutOfRange);
  EXPECT_EQ(gate.check(at(60 * kMs)), Refusal::kNone);
}

TEST(SampleGate, OneStampInTheFarFutureCostsOneSample) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(10 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(1'000'000'000 * kMs)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(20 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(30 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.refused(Refusal::kTimeJump), 1U);
  // Two of them that do not agree do no more harm.
  EXPECT_EQ(gate.check(at(2'000'000'000 * kMs)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(3'000'000'000 * kMs)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(40 * kMs)), Refusal::kNone);
}

TEST(SampleGate, ALongSilenceIsBelievedWhenTheNextSampleBearsItOut) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(10 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(9'000 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(60'000 * kMs)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(60'010 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(9'010 * kMs)), Refusal::kBackwardInTime);
}

TEST(SampleGate, AWrongFirstStampDoesNotBlockTheStream) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(1'000'000'000 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(10 * kMs)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(20 * kMs)), Refusal::kNone);
  EXPECT_EQ(gate.check(at(30 * kMs)), Refusal::kNone);
}

TEST(SampleGate, TakesTheEndsOfTime) {
  SampleGate gate;
  ASSERT_EQ(gate.check(at(std::numeric_limits<TimestampNs>::min())), Refusal::kNone);
  EXPECT_EQ(gate.check(at(std::numeric_limits<TimestampNs>::max())), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(0)), Refusal::kTimeJump);
  EXPECT_EQ(gate.check(at(10 * kMs)), Refusal::kNone);
}

TEST(SampleGate, NamesEveryReason) {
  for (const Refusal reason : kRefusals) EXPECT_STRNE(name_of(reason), "unknown");
  EXPECT_STREQ(name_of(Refusal::kTimeJump), "time_jump");
}

TEST(SampleGate, KnowsPressureAndField) {
  SampleGate gate;
  EXPECT_EQ(gate.check(PressureSample{1, 101325.0}), Refusal::kNone);
  EXPECT_EQ(gate.check(PressureSample{2, 0.0}), Refusal::kOutOfRange);
  SampleGate mag;
  EXPECT_EQ(mag.check(MagSample{1, {20.0, 0.0, -40.0}}), Refusal::kNone);
  EXPECT_EQ(mag.check(MagSample{2, {20000.0, 0.0, -40.0}}), Refusal::kOutOfRange);
}

}  // namespace
}  // namespace vpdr
