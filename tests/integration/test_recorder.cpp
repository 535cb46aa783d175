// The recorder as a process: what crosses the topics is in the file, whatever ends it.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "dds/convert.hpp"
#include "dds/serialize.hpp"
#include "integration/harness.hpp"
#include "mcap/reader.hpp"
#include "mcap/topic_counters.hpp"
#include "sensor_msgs.h"
#include "support/file_size_limit.hpp"
#include "vpdr_msgs.h"

namespace vpdr::testing_support {
namespace {

sensor_msgs::msg::Imu imu(int i) {
  ImuSample sample;
  sample.stamp_ns = kNsPerSecond + i * 10'000'000LL;
  sample.specific_force_mps2 = {0.1 * i, 0.0, 9.8};
  sensor_msgs::msg::Imu message;
  dds::to_msg(sample, message);
  return message;
}

/// Counts of messages by topic.
std::map<std::string, int> counts_in(const mcap::Reader& reader) {
  std::map<std::string, int> counts;
  mcap::MessageStream stream(reader);
  while (const auto message = stream.next()) {
    ++counts[reader.find_channel(message->channel_id)->topic];
  }
  EXPECT_TRUE(stream.damage().empty());
  return counts;
}

mcap::Reader open(const std::filesystem::path& file) {
  auto reader = mcap::Reader::open(file);
  if (!reader) throw std::runtime_error(reader.error().message);
  return std::move(reader.value());
}

/// A recorder and a board in its place.
class RecorderProcess : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--out", file_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    recorder_.emplace(domain_.start("recorder", arguments));
    ASSERT_TRUE(samples_.wait_for_matched(1, kPatience)) << recorder_->last_lines(5);
  }
  void publish(int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(samples_.publish(imu(published_++)));
      // No further ahead than the history of a writer that does not wait.
      if (published_ % 500 != 0) continue;
      ASSERT_TRUE(samples_.wait_for_acknowledgments(kPatience));
    }
    ASSERT_TRUE(samples_.wait_for_acknowledgments(kPatience));
  }
  std::string log() { return recorder_->last_lines(20); }

  TestDomain domain_{150};
  std::filesystem::path file_ = domain_.folder() / "walk.mcap";
  dds::Publisher<sensor_msgs::msg::Imu> samples_{domain_.participant(), dds::topics::kImuRaw};
  std::optional<tool::ChildProcess> recorder_;
  int published_ = 0;
};

TEST_F(RecorderProcess, RecordsEveryTopicOfItsWalkerAlsoLateOnesAndNoOther) {
  dds::ParticipantOptions other_walker;
  other_walker.walker = "other";
  other_walker.service = "pdr";
  other_walker.domain = domain_.domain();
  other_walker.interfaces = {"127.0.0.1"};
  dds::Participant other(other_walker);
  dds::Publisher others_steps(other, dds::topics::kStep);
  start();
  publish(300);
  dds::Publisher late(domain_.participant(), dds::topics::kStep);
  ASSERT_TRUE(late.wait_for_matched(1, kPatience));
  vpdr_msgs::msg::Step step;
  step.index(7);
  ASSERT_TRUE(late.publish(step));
  ASSERT_TRUE(late.wait_for_acknowledgments(kPatience));
  publish(2700);
  EXPECT_EQ(others_steps.matched_count(), 0U);
  recorder_->signal(SIGTERM);
  ASSERT_EQ(recorder_->wait(kPatience), 0) << log();

  const mcap::Reader reader = open(file_);
  EXPECT_EQ(reader.contents().incomplete, "");
  const auto counts = counts_in(reader);
  EXPECT_EQ(counts.at("/walker/imu/data_raw"), 3000);
  EXPECT_EQ(counts.at("/walker/pdr/step"), 1);
  EXPECT_FALSE(counts.contains("/other/pdr/step"));
  EXPECT_TRUE(counts.contains("/walker/diagnostics")) << "its own reports are recorded too";
}

TEST_F(RecorderProcess, HoldsTheBytesAndTimesAsTheyCame) {
  start();
  publish(100);
  recorder_->signal(SIGINT);
  ASSERT_EQ(recorder_->wait(kPatience), 0) << log();
  const mcap::Reader reader = open(file_);
  mcap::Selection selection;
  selection.topics = {"/walker/imu/data_raw"};
  mcap::MessageStream stream(reader, selection);
  for (int i = 0; i < 100; ++i) {
    const auto message = stream.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->sequence, static_cast<std::uint32_t>(i + 1));
    EXPECT_LE(message->publish_time_ns, message->log_time_ns) << "sent before it came";
    EXPECT_LT(message->log_time_ns - message->publish_time_ns, 60 * kNsPerSecond);
    sensor_msgs::msg::Imu read;
    ASSERT_TRUE(dds::deserialize(message->data, read));
    EXPECT_DOUBLE_EQ(read.linear_acceleration().x(), 0.1 * i);
  }
  for (const mcap::Metadata& record : reader.contents().metadata) {
    if (record.name != mcap::kCountersRecord) continue;
    const auto counters = mcap::find_counters("imu/data_raw", record.entries);
    ASSERT_TRUE(counters);
    EXPECT_EQ(counters->received, 100U);
    EXPECT_EQ(counters->written, 100U);
    EXPECT_EQ(counters->lost, 0U);
  }
}

TEST_F(RecorderProcess, CountsOnTheDiagnosticsTopic) {
  start();
  publish(250);
  EXPECT_TRUE(domain_.wait_diagnostic("recorder", "imu/data_raw.received", "250"));
  EXPECT_TRUE(domain_.wait_diagnostic("recorder", "imu/data_raw.written", "250"))
      << "a chunk is written each second";
  EXPECT_EQ(domain_.diagnostic_of("recorder", "imu/data_raw.lost"), "0");
}

// A gateway paces its playback by these reports; it may come to know the recorder late.
TEST_F(RecorderProcess, SaysHowFarItIsToThoseWhoComeLateToo) {
  start();
  publish(100);
  Collector<vpdr_msgs::msg::Progress> progress(domain_.participant(), dds::topics::kProgress);
  EXPECT_TRUE(progress.wait([](const auto& reports) {
    return !reports.empty() &&
           dds::from_msg(reports.back().header().stamp()) >= kNsPerSecond + 980'000'000;
  }));
}

TEST_F(RecorderProcess, KilledItLeavesWhatWasWritten) {
  start();
  publish(1000);
  ASSERT_TRUE(domain_.wait_diagnostic("recorder", "imu/data_raw.written", "1000"));
  publish(10);
  recorder_->signal(SIGKILL);
  ASSERT_EQ(recorder_->wait(kPatience), 128 + SIGKILL);
  const mcap::Reader reader = open(file_);
  EXPECT_EQ(reader.contents().incomplete.find("the file"), 0U) << reader.contents().incomplete;
  EXPECT_GE(counts_in(reader).at("/walker/imu/data_raw"), 1000);
}

TEST_F(RecorderProcess, AFullDiskEndsItWithWhatThereIsAndSaysSo) {
  {
    const vpdr::testing::FileSizeLimit full(100 << 10);
    start({"--set", "compression_level=0", "--set", "chunk_kib=8"});
  }
  publish(1000);
  ASSERT_EQ(recorder_->wait(kPatience), 6) << log();
  EXPECT_NE(log().find("walk.mcap: cannot write"), std::string::npos) << log();
  EXPECT_NE(log().find("free some space"), std::string::npos) << log();
  const auto counts = counts_in(open(file_));
  EXPECT_GT(counts.at("/walker/imu/data_raw"), 100);
  EXPECT_LT(counts.at("/walker/imu/data_raw"), 1000);
}

TEST_F(RecorderProcess, RefusesARecordingThatIsThere) {
  std::ofstream(file_) << "precious";
  auto recorder = domain_.start("recorder", {"--out", file_});
  ASSERT_EQ(recorder.wait(kPatience), 6);
  EXPECT_NE(recorder.last_lines(5).find("never overwritten"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(file_), 8U);
}

TEST_F(RecorderProcess, ASecondOneForTheSameWalkerIsRefused) {
  start();
  ASSERT_TRUE(domain_.wait_diagnostic("recorder", "state", "running"));
  auto second = domain_.start("recorder", {"--out", domain_.folder() / "second.mcap"});
  ASSERT_EQ(second.wait(kPatience), 5) << second.last_lines(5);
  publish(10);
  recorder_->signal(SIGTERM);
  ASSERT_EQ(recorder_->wait(kPatience), 0) << log();
  EXPECT_EQ(counts_in(open(file_)).at("/walker/imu/data_raw"), 10);
}

TEST_F(RecorderProcess, InfoTellsWhatAFileHolds) {
  start();
  publish(20);
  recorder_->signal(SIGTERM);
  ASSERT_EQ(recorder_->wait(kPatience), 0) << log();
  const auto program = std::filesystem::path(VPDR_BIN_DIR) / "recorder";
  tool::ChildProcess info("info", program, {"info", file_}, domain_.folder() / "info.log");
  ASSERT_EQ(info.wait(kPatience), 0);
  const std::string text = info.last_lines(30);
  EXPECT_NE(text.find("complete"), std::string::npos) << text;
  EXPECT_NE(text.find("/walker/imu/data_raw"), std::string::npos) << text;
  tool::ChildProcess other("info", program, {"info", domain_.folder() / "info.log"},
                           domain_.folder() / "other.log");
  ASSERT_EQ(other.wait(kPatience), 6);
  EXPECT_NE(other.last_lines(5).find("is no MCAP recording"), std::string::npos);
}

TEST_F(RecorderProcess, AnIndependentReaderDecodesIt) {
  const char* const reader = std::getenv("VPDR_INDEPENDENT_READER");
  if (reader == nullptr) GTEST_SKIP() << "skipped: VPDR_INDEPENDENT_READER is not set";
  start();
  publish(200);
  recorder_->signal(SIGTERM);
  ASSERT_EQ(recorder_->wait(kPatience), 0) << log();
  const std::string command =
      std::string(reader) + " --expect /walker/imu/data_raw=200 " + file_.string();
  const auto log = domain_.folder() / "reader.log";
  tool::ChildProcess process("reader", "/bin/sh", {"-c", command}, log);
  const auto code = process.wait(kPatience);
  if (code == 77) GTEST_SKIP() << "skipped: PyPI not reachable";
  ASSERT_EQ(code, 0) << process.last_lines(20);
  EXPECT_NE(process.last_lines(20).find("200 x sensor_msgs/msg/Imu"), std::string::npos)
      << process.last_lines(20);
}

}  // namespace
}  // namespace vpdr::testing_support
