#include <gtest/gtest.h>

#include "dds/detail/sequence.hpp"
#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "sensor_msgs.h"
#include "tests/unit/dds/gate.hpp"
#include "tests/unit/dds/loopback.hpp"

namespace vpdr::dds::test {
namespace {

constexpr std::uint32_t kDomain = 101;

TEST(SequenceGaps, CountsWhatIsMissingOfEachWriter) {
  detail::SequenceGaps gaps;
  const Guid a{1};
  const Guid b{2};
  EXPECT_EQ(gaps.gap_before(a, 7), 0U) << "what was before the first is not missing";
  EXPECT_EQ(gaps.gap_before(a, 8), 0U);
  EXPECT_EQ(gaps.gap_before(b, 1), 0U);
  EXPECT_EQ(gaps.gap_before(a, 12), 3U);
  EXPECT_EQ(gaps.gap_before(a, 10), 0U) << "late: counted already";
  EXPECT_EQ(gaps.gap_before(a, 13), 0U);
  EXPECT_EQ(gaps.gap_before(b, 3), 1U);
}

// Images on the best-effort topic overflow the socket while the reader does not look.
TEST(Losses, AreCountedExactlyOnABestEffortTopic) {
  const Participant sender(loopback(kDomain, "sender"));
  const Participant receiver(loopback(kDomain, "receiver"));
  Gate gate;
  gate.close();
  Collected<std::uint64_t> sequence;
  Subscription subscription(receiver, topics::kImage,
                            [&](const sensor_msgs::msg::CompressedImage&, const SampleInfo& info) {
                              gate.pass();
                              sequence.add(info.sequence_number);
                            });
  auto now = topics::kImage;
  now.info.qos.large = false;  // publish() returns when the datagram is with the kernel
  Publisher publisher(sender, now);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  ASSERT_TRUE(subscription.wait_for_matched(1, kPatience));
  sensor_msgs::msg::CompressedImage image;
  image.data().resize(50'000);
  constexpr std::uint64_t kBurst =
      400;  // 20 MB; the socket buffer is 4 MiB, 8 as the kernel counts
  for (std::uint64_t i = 0; i < kBurst; ++i) ASSERT_TRUE(publisher.publish(image));
  gate.open();
  // Best effort: send on until one comes after the burst.
  while (!subscription.wait_for([](const ReaderCounts& c) { return c.received + c.lost >= kBurst; },
                                std::chrono::milliseconds(20))) {
    ASSERT_LT(publisher.published(), kBurst + 1000);
    ASSERT_TRUE(publisher.publish(image));
  }
  const auto counts = subscription.counts();
  const auto seen = sequence.items();
  EXPECT_GT(counts.lost, 0U);
  EXPECT_EQ(counts.received, seen.size());
  EXPECT_EQ(counts.received + counts.lost, seen.back() - seen.front() + 1);
  EXPECT_EQ(counts.unreadable, 0U);
}

TEST(Losses, SilenceOnATopicWithADeadlineIsCounted) {
  const Participant sender(loopback(kDomain, "sender"));
  const Participant receiver(loopback(kDomain, "receiver"));
  Subscription subscription(receiver, topics::kImuRaw,
                            [](const sensor_msgs::msg::Imu&, const SampleInfo&) {});
  Publisher publisher(sender, topics::kImuRaw);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  ASSERT_TRUE(publisher.publish({}));
  EXPECT_TRUE(subscription.wait_for([](const ReaderCounts& c) { return c.deadline_missed > 0; },
                                    kPatience));
  EXPECT_EQ(subscription.alive_count(), 1U);
}

TEST(Losses, BytesWithoutEncapsulationAreNotSent) {
  const Participant sender(loopback(kDomain, "sender"));
  RawPublisher writer(sender,
                      {.topic = "rt/tester/pressure", .type = "sensor_msgs/msg/FluidPressure"});
  EXPECT_FALSE(writer.publish({}));
  EXPECT_EQ(writer.refused(), 1U);
  EXPECT_EQ(writer.published(), 0U);
}

TEST(Losses, BytesThatDoNotFitTheTypeAreCountedAndHeldBack) {
  const Participant sender(loopback(kDomain, "sender"));
  const Participant receiver(loopback(kDomain, "receiver"));
  Collected<double> seen;
  const Topic<sensor_msgs::msg::FluidPressure> plain{
      {"pressure", "sensor_msgs/msg/FluidPressure", "", {}}};
  Subscription reader(receiver, plain,
                      [&](const sensor_msgs::msg::FluidPressure& message, const SampleInfo&) {
                        seen.add(message.fluid_pressure());
                      });
  RawPublisher writer(sender,
                      {.topic = "rt/tester/pressure", .type = "sensor_msgs/msg/FluidPressure"});
  ASSERT_TRUE(writer.wait_for_matched(1, kPatience));
  // Little-endian CDR: stamp 1 s, frame "", pressure 2.0, variance 0; then the same cut short, and
  // with a frame longer than the sample.
  std::vector<std::byte> sample(4 + 32);
  sample[1] = std::byte{1};
  sample[4] = std::byte{1};
  sample[12] = std::byte{1};  // length of the string: its zero
  sample[4 + 16 + 7] = std::byte{0x40};
  auto cut = sample;
  cut.resize(22);
  auto endless = sample;
  endless[15] = std::byte{0x7f};
  ASSERT_TRUE(writer.publish(cut));
  ASSERT_TRUE(writer.publish(endless));
  ASSERT_TRUE(writer.publish(sample));
  ASSERT_TRUE(seen.wait_for(1));
  EXPECT_EQ(seen.items(), std::vector<double>{2.0});
  EXPECT_EQ(reader.counts().unreadable, 2U);
  EXPECT_EQ(reader.counts().lost, 0U);
}

}  // namespace
}  // namespace vpdr::dds::test
