// What vpdr publishes, read by another vendor's DDS in a process of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "dds/convert.hpp"
#include "dds/publisher.hpp"
#include "geometry_msgs.h"
#include "sensor_msgs.h"

extern char** environ;

namespace vpdr::dds {
namespace {

constexpr std::uint32_t kDomain = 119;
constexpr TimestampNs kSamples = 500;
constexpr TimestampNs kPeriodNs = 5'000'000;
constexpr std::chrono::milliseconds kPatience{30'000};
constexpr const char* kLoopbackOnly =
    "<CycloneDDS><Domain><General><Interfaces>"
    "<NetworkInterface address=\"127.0.0.1\" multicast=\"true\"/>"
    "</Interfaces></General></Domain></CycloneDDS>";

class CycloneReader : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("CYCLONEDDS_URI", kLoopbackOnly, 1);
    start_reader();
    ASSERT_TRUE(imu_.wait_for_matched(1, kPatience));
    ASSERT_TRUE(pose_.wait_for_matched(1, kPatience));
    pollfd ready{fileno(output_), POLLIN, 0};
    for (int i = 0; i < 1000 && ready.revents == 0; ++i) {
      ASSERT_TRUE(publish_next());
      poll(&ready, 1, 20);
    }
    char line[16] = {};
    ASSERT_NE(std::fgets(line, sizeof(line), output_), nullptr);
    ASSERT_STREQ(line, "ready\n");
  }

  void start_reader() {
    std::vector<std::string> words{std::string(VPDR_TEST_BIN_DIR) + "/cyclone_reader",
                                   std::to_string(kDomain),
                                   "tester",
                                   std::to_string(kSamples),
                                   std::to_string(kSamples),
                                   "60",
                                   std::to_string(kPeriodNs)};
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    int pipe_ends[2];
    ASSERT_EQ(pipe2(pipe_ends, O_CLOEXEC), 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    const int failed =
        posix_spawn(&reader_, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    output_ = fdopen(pipe_ends[0], "r");
    ASSERT_EQ(failed, 0);
  }

  void TearDown() override {
    if (reader_ != 0) exit_code();
    std::fclose(output_);
  }

  /// Of the reader, once it has ended by itself.
  int exit_code() {
    char line[128];
    while (std::fgets(line, sizeof(line), output_) != nullptr) std::fputs(line, stdout);
    int status = 0;
    waitpid(std::exchange(reader_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool publish_next() { return publish(++sent_ * kPeriodNs); }

  bool publish(TimestampNs stamp_ns) {
    to_msg(ImuSample{stamp_ns, {0.1, 0.2, 9.8}, {0.0, 0.0, 0.5}, true}, imu_message_);
    to_msg(PoseEstimate{.stamp_ns = stamp_ns, .position_m = {1.0, 2.0, 0.0}}, Frame::kMap,
           pose_message_);
    return imu_.publish(imu_message_) && pose_.publish(pose_message_);
  }

  static ParticipantOptions options() {
    ParticipantOptions options;
    options.walker = "tester";
    options.service = "sender";
    options.domain = kDomain;
    options.interfaces = {"127.0.0.1"};
    return options;
  }

  pid_t reader_ = 0;
  std::FILE* output_ = nullptr;
  TimestampNs sent_ = 0;
  Participant participant_{options()};
  Publisher<sensor_msgs::msg::Imu> imu_{participant_, topics::kImuRaw};
  Publisher<geometry_msgs::msg::PoseWithCovarianceStamped> pose_{participant_, topics::kFusedPose};
  sensor_msgs::msg::Imu imu_message_;
  geometry_msgs::msg::PoseWithCovarianceStamped pose_message_;
};

TEST_F(CycloneReader, ReceivesEverySampleInOrder) {
  const TimestampNs wanted = sent_ + kSamples;
  while (sent_ < kSamples - 1) ASSERT_TRUE(publish_next());
  EXPECT_TRUE(imu_.wait_for_acknowledgments(kPatience));
  EXPECT_TRUE(pose_.wait_for_acknowledgments(kPatience));
  while (sent_ < wanted) ASSERT_TRUE(publish_next());
  EXPECT_EQ(exit_code(), 0);
}

TEST_F(CycloneReader, ChecksWhatItReceives) {
  ASSERT_TRUE(publish(sent_ * kPeriodNs));  // that stamp once more
  EXPECT_EQ(exit_code(), 2);
}

}  // namespace
}  // namespace vpdr::dds
