#include <gtest/gtest.h>

#include <atomic>

#include "core/errors.hpp"
#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "nav_msgs.h"
#include "tests/unit/dds/gate.hpp"
#include "tests/unit/dds/loopback.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds::test {
namespace {

using std::chrono::milliseconds;
using vpdr_msgs::msg::Step;

constexpr std::uint32_t kDomain = 100;

class Endpoints : public ::testing::Test {
 protected:
  Participant sender_{loopback(kDomain, "sender")};
  Participant receiver_{loopback(kDomain, "receiver")};
};

Step step(std::uint32_t index) {
  Step message;
  message.index(index);
  return message;
}

TEST_F(Endpoints, SamplesArriveInOrderWithTimesAndSequenceNumbers) {
  Collected<std::pair<std::uint32_t, SampleInfo>> seen;
  Subscription subscription(receiver_, topics::kStep,
                            [&](const Step& message, const SampleInfo& info) {
                              seen.add({message.index(), info});
                            });
  Publisher publisher(sender_, topics::kStep);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  for (std::uint32_t i = 1; i <= 50; ++i) ASSERT_TRUE(publisher.publish(step(i)));
  ASSERT_TRUE(seen.wait_for(50));
  std::int64_t sent_before = 0;
  for (std::uint32_t i = 1; i <= 50; ++i) {
    const auto [index, info] = seen.items()[i - 1];
    EXPECT_EQ(index, i);
    EXPECT_EQ(info.sequence_number, i);
    EXPECT_EQ(info.lost_before, 0U);
    EXPECT_GE(info.source_timestamp_ns, sent_before);
    // One clock; the wire's fractions of 2^-32 s round by a nanosecond.
    EXPECT_GE(info.reception_timestamp_ns, info.source_timestamp_ns - 2);
    sent_before = info.source_timestamp_ns;
  }
  EXPECT_EQ(publisher.published(), 50U);
  EXPECT_EQ(publisher.refused(), 0U);
}

TEST_F(Endpoints, MatchesAreCountedAtBothEnds) {
  Publisher publisher(sender_, topics::kStep);
  EXPECT_EQ(publisher.matched_count(), 0U);
  EXPECT_FALSE(publisher.wait_for_matched(1, milliseconds(1)));
  {
    Subscription subscription(receiver_, topics::kStep, [](const Step&, const SampleInfo&) {});
    EXPECT_TRUE(publisher.wait_for_matched(1, kPatience));
    EXPECT_TRUE(subscription.wait_for_matched(1, kPatience));
    EXPECT_EQ(subscription.matched_count(), 1U);
  }
  EXPECT_TRUE(publisher.wait_for_unmatched(kPatience));
  EXPECT_EQ(publisher.matched_count(), 0U);
}

// While the callback works on a sample no acknowledgment goes out, whenever the writer's last
// heartbeat came: the samples sent one by one meet the heartbeats at ever other phases.
TEST_F(Endpoints, AcknowledgedMeansProcessed) {
  Gate gate;
  Subscription subscription(receiver_, topics::kStep,
                            [&](const Step&, const SampleInfo&) { gate.pass(); });
  Publisher publisher(sender_, topics::kStep);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  for (std::uint32_t i = 1; i <= 8; ++i) {
    gate.open();
    ASSERT_TRUE(publisher.publish(step(0)));
    ASSERT_TRUE(gate.wait_for_arrivals(2 * i - 1));
    gate.close();
    ASSERT_TRUE(publisher.publish(step(i)));
    ASSERT_TRUE(gate.wait_for_arrivals(2 * i));
    EXPECT_FALSE(publisher.wait_for_acknowledgments(milliseconds(60)));
    EXPECT_EQ(gate.departures(), 2 * i - 1);
    gate.open();
    ASSERT_TRUE(publisher.wait_for_acknowledgments(kPatience));
    EXPECT_EQ(gate.departures(), 2 * i);
  }
}

TEST_F(Endpoints, AcknowledgmentsCoverEverySampleOfABurst) {
  std::atomic<std::uint32_t> processed = 0;
  Subscription subscription(receiver_, topics::kStep, [&](const Step&, const SampleInfo&) {
    std::this_thread::yield();
    ++processed;
  });
  Publisher publisher(sender_, topics::kStep, {.lossless = true});
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  for (std::uint32_t round = 1; round <= 20; ++round) {
    for (std::uint32_t i = 0; i < 50; ++i) ASSERT_TRUE(publisher.publish(step(i)));
    ASSERT_TRUE(publisher.wait_for_acknowledgments(kPatience));
    EXPECT_EQ(processed, 50 * round);
  }
}

TEST_F(Endpoints, LosslessPublisherWaitsForTheReader) {
  Gate gate;
  gate.close();
  std::atomic<std::uint32_t> processed = 0;
  Subscription subscription(receiver_, topics::kStep, [&](const Step&, const SampleInfo&) {
    gate.pass();
    ++processed;
  });
  Publisher publisher(sender_, topics::kStep, {.lossless = true, .patience = milliseconds(50)});
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  const auto depth = static_cast<std::uint32_t>(topics::kStep.info.qos.depth);
  for (std::uint32_t i = 1; i <= depth; ++i) ASSERT_TRUE(publisher.publish(step(i))) << i;
  EXPECT_FALSE(publisher.publish(step(depth + 1))) << "nothing was taken, and nothing pushed out";
  EXPECT_EQ(publisher.refused(), 1U);
  gate.open();
  ASSERT_TRUE(publisher.wait_for_acknowledgments(kPatience));
  EXPECT_TRUE(publisher.publish(step(depth + 1)));
  ASSERT_TRUE(publisher.wait_for_acknowledgments(kPatience));
  EXPECT_EQ(processed, depth + 1);
  EXPECT_EQ(subscription.counts().lost, 0U);
}

TEST_F(Endpoints, LateReaderGetsTheLastSampleOfALatchedTopic) {
  Publisher publisher(sender_, topics::kCalibration);
  vpdr_msgs::msg::Calibration calibration;
  calibration.board("old");
  ASSERT_TRUE(publisher.publish(calibration));
  calibration.board("head");
  ASSERT_TRUE(publisher.publish(calibration));
  Collected<std::string> seen;
  Subscription subscription(receiver_, topics::kCalibration,
                            [&](const vpdr_msgs::msg::Calibration& message, const SampleInfo&) {
                              seen.add(message.board());
                            });
  ASSERT_TRUE(seen.wait_for(1));
  EXPECT_EQ(seen.items(), std::vector<std::string>{"head"});
}

TEST_F(Endpoints, LongPathIsSentInPieces) {
  Collected<std::size_t> seen;
  Subscription subscription(
      receiver_, topics::kPath,
      [&](const nav_msgs::msg::Path& path, const SampleInfo&) { seen.add(path.poses().size()); });
  Publisher publisher(sender_, topics::kPath);
  ASSERT_TRUE(publisher.wait_for_matched(1, kPatience));
  nav_msgs::msg::Path path;
  path.poses().resize(20'000);  // 1.4 MB: a walk of three hours
  ASSERT_TRUE(publisher.publish(path));
  ASSERT_TRUE(seen.wait_for(1));
  EXPECT_EQ(seen.items()[0], 20'000U);
}

TEST_F(Endpoints, IncompatibleReaderIsReportedAtBothEndsWithTheTopicAndThePolicy) {
  auto demanding = topics::kStep;
  demanding.info.qos.transient_local = true;
  Collected<Problem> at_receiver;
  Collected<Problem> at_sender;
  auto options = loopback(kDomain, "demanding");
  options.on_problem = [&](const Problem& problem) { at_receiver.add(problem); };
  const Participant receiver(options);
  options = loopback(kDomain, "modest");
  options.on_problem = [&](const Problem& problem) { at_sender.add(problem); };
  Participant sender(options);
  Publisher publisher(sender, topics::kStep);
  Subscription subscription(receiver, demanding, [](const Step&, const SampleInfo&) {});
  ASSERT_TRUE(at_receiver.wait_for(1));
  ASSERT_TRUE(at_sender.wait_for(1));
  for (const auto& problem : {at_receiver.items()[0], at_sender.items()[0]}) {
    EXPECT_EQ(problem.kind, ProblemKind::kIncompatibleQos);
    EXPECT_EQ(problem.topic, "rt/tester/pdr/step");
    EXPECT_NE(problem.text.find("durability"), std::string::npos) << problem.text;
  }
  EXPECT_EQ(publisher.matched_count(), 0U);
  EXPECT_EQ(sender.take_problems().size(), 1U);
  EXPECT_TRUE(sender.take_problems().empty());
}

TEST_F(Endpoints, OtherTypeOnATopicIsReported) {
  Collected<Problem> problems;
  auto options = loopback(kDomain, "witness");
  options.on_problem = [&](const Problem& problem) { problems.add(problem); };
  const Participant witness(options);
  Subscription subscription(witness, topics::kStep, [](const Step&, const SampleInfo&) {});
  const Topic<vpdr_msgs::msg::Heading> wrong{{"pdr/step", "vpdr_msgs/msg/Heading", "pdr", {}}};
  Publisher publisher(sender_, wrong);
  ASSERT_TRUE(problems.wait_for(1));
  const auto problem = problems.items()[0];
  EXPECT_EQ(problem.kind, ProblemKind::kTypeMismatch);
  EXPECT_EQ(problem.topic, "rt/tester/pdr/step");
  EXPECT_NE(problem.text.find("vpdr/tester/sender uses it as vpdr_msgs/msg/Heading"),
            std::string::npos)
      << problem.text;
}

TEST_F(Endpoints, OneParticipantUsesATopicWithOneTypeOnly) {
  Publisher steps(sender_, topics::kStep);
  const Topic<vpdr_msgs::msg::Heading> wrong{{"pdr/step", "vpdr_msgs/msg/Heading", "pdr", {}}};
  EXPECT_THROW(Publisher<vpdr_msgs::msg::Heading>(sender_, wrong), DdsFault);
}

}  // namespace
}  // namespace vpdr::dds::test
