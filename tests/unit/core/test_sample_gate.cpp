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
