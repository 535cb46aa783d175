#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

#include "recorder/app/sample_queue.hpp"

namespace vpdr::recorder {
namespace {

using namespace std::chrono_literals;

std::vector<std::byte> bytes(std::size_t count, int value) {
  return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

QueuedSample numbered(std::uint32_t sequence) {
  QueuedSample sample;
  sample.sequence = sequence;
  return sample;
}

TEST(SampleQueue, GivesSamplesInOrderWithTheirPayloads) {
  SampleQueue queue(1000);
  ASSERT_TRUE(queue.push(numbered(1), bytes(3, 7)));
  ASSERT_TRUE(queue.push(numbered(2), bytes(0, 0)));
  ASSERT_TRUE(queue.push(numbered(3), bytes(2, 9)));
  Batch batch;
  ASSERT_TRUE(queue.take(batch, 0ms));
  ASSERT_EQ(batch.samples.size(), 3U);
  const auto last = batch.payload_of(batch.samples[2]);
  EXPECT_EQ(std::vector<std::byte>(last.begin(), last.end()), bytes(2, 9));
  EXPECT_TRUE(batch.payload_of(batch.samples[1]).empty());
  EXPECT_EQ(queue.waits(), 0U);
}

TEST(SampleQueue, GivesAnEmptyBatchWhenNothingCame) {
  SampleQueue queue(1000);
  Batch batch;
  batch.samples.resize(4);
  EXPECT_TRUE(queue.take(batch, 1ms));
  EXPECT_TRUE(batch.samples.empty());
}

TEST(SampleQueue, PushWaitsForRoomAndLosesNothing) {
  SampleQueue queue(10);
  ASSERT_TRUE(queue.push(numbered(1), bytes(8, 1)));
  auto second =
      std::async(std::launch::async, [&] { return queue.push(numbered(2), bytes(8, 2)); });
  while (queue.waits() == 0) std::this_thread::yield();
  Batch batch;
  ASSERT_TRUE(queue.take(batch, 0ms));
  ASSERT_EQ(batch.samples.size(), 1U);
  EXPECT_TRUE(second.get());
  ASSERT_TRUE(queue.take(batch, 0ms));
  ASSERT_EQ(batch.samples.size(), 1U);
  EXPECT_EQ(batch.samples[0].sequence, 2U);
}

TEST(SampleQueue, TakesASampleLargerThanItselfWhenEmpty) {
  SampleQueue queue(10);
  EXPECT_TRUE(queue.push(numbered(1), bytes(100, 1)));
}

TEST(SampleQueue, ClosingFreesAWaitingPushAndKeepsWhatIsThere) {
  SampleQueue queue(10);
  ASSERT_TRUE(queue.push(numbered(1), bytes(8, 1)));
  auto second =
      std::async(std::launch::async, [&] { return queue.push(numbered(2), bytes(8, 2)); });
  while (queue.waits() == 0) std::this_thread::yield();
  queue.close();
  EXPECT_FALSE(second.get());
  Batch batch;
  EXPECT_TRUE(queue.take(batch, 0ms));
  EXPECT_EQ(batch.samples.size(), 1U);
  EXPECT_FALSE(queue.take(batch, 0ms));
}

TEST(SampleQueue, ManySendersOneTaker) {
  constexpr std::uint32_t kEach = 2000;
  SampleQueue queue(500);
  std::vector<std::jthread> senders;
  for (std::size_t topic = 0; topic < 3; ++topic) {
    senders.emplace_back([&queue, topic] {
      for (std::uint32_t i = 1; i <= kEach; ++i) {
        QueuedSample sample = numbered(i);
        sample.topic = topic;
        queue.push(sample, bytes(7, static_cast<int>(i & 0xFF)));
      }
    });
  }
  std::array<std::uint32_t, 3> last{};
  std::size_t count = 0;
  for (Batch batch; count < 3 * kEach;) {
    ASSERT_TRUE(queue.take(batch, 1000ms));
    for (const QueuedSample& sample : batch.samples) {
      EXPECT_EQ(sample.sequence, last[sample.topic] + 1);
      last[sample.topic] = sample.sequence;
      EXPECT_EQ(std::to_integer<std::uint32_t>(batch.payload_of(sample)[6]),
                sample.sequence & 0xFFU);
      ++count;
    }
  }
}

}  // namespace
}  // namespace vpdr::recorder
