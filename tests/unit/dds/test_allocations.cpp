// What vpdr does for a sample takes no memory from the heap: every allocation is counted here.
// (Fast DDS 2.9.1 itself takes ten small pieces for each sample sent and one for each received.)
#include <gtest/gtest.h>

#include <vector>

#include "dds/convert.hpp"
#include "dds/detail/envelope.hpp"
#include "sensor_msgs.h"
#include "tests/support/counted_allocations.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds {
namespace {

using eprosima::fastrtps::rtps::SerializedPayload_t;

template <class Msg, class Core>
std::size_t allocations_of_ten_samples(const Core& sample) {
  detail::EnvelopeType type_support("any");
  Msg sent;
  Msg received;
  Core back;
  SerializedPayload_t payload(4096);
  const auto there_and_back = [&] {
    to_msg(sample, sent);
    detail::Envelope out{.type = &message_type<Msg>(), .message = &sent};
    const bool fits = type_support.getSerializedSizeProvider(&out)() <= payload.max_size;
    const bool serialized = type_support.serialize(&out, &payload);
    detail::Envelope in{.type = &message_type<Msg>(), .target = &received};
    const bool deserialized = type_support.deserialize(&payload, &in);
    from_msg(received, back);
    return fits && serialized && deserialized && in.readable && back.stamp_ns == sample.stamp_ns;
  };
  EXPECT_TRUE(there_and_back());
  const std::size_t before = vpdr::testing::allocations;
  bool good = true;
  for (int i = 0; i < 10; ++i) good = there_and_back() && good;
  const std::size_t taken = vpdr::testing::allocations - before;
  EXPECT_TRUE(good);
  return taken;
}

TEST(Allocations, TheCounterCounts) {
  const std::size_t before = vpdr::testing::allocations;
  const std::vector<int> taken(1000);
  EXPECT_EQ(vpdr::testing::allocations, before + 1) << taken.size();
}

TEST(Allocations, SamplesAndEstimatesTakeNone) {
  EXPECT_EQ(allocations_of_ten_samples<sensor_msgs::msg::Imu>(ImuSample{.stamp_ns = 1}), 0U);
  EXPECT_EQ(allocations_of_ten_samples<sensor_msgs::msg::MagneticField>(MagSample{.stamp_ns = 1}),
            0U);
  EXPECT_EQ(allocations_of_ten_samples<sensor_msgs::msg::Imu>(AttitudeEstimate{.stamp_ns = 1}), 0U);
  EXPECT_EQ(allocations_of_ten_samples<vpdr_msgs::msg::Step>(StepEvent{.stamp_ns = 1}), 0U);
  EXPECT_EQ(allocations_of_ten_samples<vpdr_msgs::msg::Heading>(HeadingEstimate{.stamp_ns = 1}),
            0U);
  EXPECT_EQ(allocations_of_ten_samples<vpdr_msgs::msg::HeadingRate>(HeadingRate{.stamp_ns = 1}),
            0U);
}

}  // namespace
}  // namespace vpdr::dds
