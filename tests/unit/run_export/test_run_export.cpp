// Recordings made by hand, exported, and read back as a run.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "dds/convert.hpp"
#include "dds/schema.hpp"
#include "dds/serialize.hpp"
#include "dds/topics.hpp"
#include "diagnostic_msgs.h"
#include "evaluation/run_directory.hpp"
#include "geometry_msgs.h"
#include "mcap/topic_counters.hpp"
#include "mcap/writer.hpp"
#include "nav_msgs.h"
#include "run_export/imu_times.hpp"
#include "run_export/run_export.hpp"
#include "sensor_msgs.h"
#include "tests/support/temporary_folder.hpp"
#include "vpdr_msgs.h"

namespace vpdr::run_export {
namespace {

namespace topics = dds::topics;
using vpdr::testing::TemporaryFolder;

constexpr TimestampNs kStart = 1000 * kNsPerSecond;      // sensor time
constexpr TimestampNs kHost = 1'700'000 * kNsPerSecond;  // host time
constexpr TimestampNs kPeriod = kNsPerSecond / 100;

TEST(ImuTimes, AnswersEachStampOnce) {
  ImuTimes times;
  times.add(20, 200);
  times.add(10, 100);
  times.add(20, 999);
  times.add(30, 300);
  times.add(40, 400);
  times.sort();
  EXPECT_FALSE(times.answer(15));
  EXPECT_EQ(times.answer(20), 200) << "of two with one stamp the first counts";
  EXPECT_FALSE(times.answer(20)) << "answered";
  EXPECT_EQ(times.answer(40), 400);
  EXPECT_EQ(times.unanswered(), 1U) << "30; what is before the first answer does not count";
  EXPECT_DOUBLE_EQ(times.duration_s(), 3e-8);
}

TEST(ImuTimes, NothingComesOfNothing) {
  ImuTimes times;
  times.sort();
  EXPECT_FALSE(times.answer(1));
  EXPECT_EQ(times.unanswered(), 0U);
  EXPECT_EQ(times.duration_s(), 0.0);
}

/// Writes messages as the recorder does.
class Recorded {
 public:
  explicit Recorded(const std::filesystem::path& file)
      : writer_(std::move(mcap::Writer::create(file).value())) {}

  template <class T>
  void add(const dds::Topic<T>& topic, const T& message, TimestampNs publish_ns, TimestampNs log_ns,
           const std::string& walker = "ann") {
    const std::string path = "/" + walker + "/" + std::string(topic.info.name);
    if (!channels_.contains(path)) {
      const std::string type(topic.info.type);
      const auto schema = writer_.add_schema(type, "ros2msg", dds::ros2msg_schema(type));
      channels_[path] = writer_.add_channel({0, schema.value(), path, "cdr", {}}).value();
    }
    const std::vector<std::byte> bytes = dds::serialize(message);
    ASSERT_TRUE(writer_.write(mcap::Message{channels_[path], 1, log_ns, publish_ns, bytes}));
  }

  mcap::Writer& writer() { return writer_; }

 private:
  mcap::Writer writer_;
  std::map<std::string, std::uint16_t> channels_;
};

PoseEstimate pose_at(TimestampNs stamp_ns, double x) {
  PoseEstimate pose;
  pose.stamp_ns = stamp_ns;
  pose.position_m = {x, 2.0, 0.0};
  pose.covariance = Matrix6d::Identity() * 0.25;
  return pose;
}

nav_msgs::msg::Odometry odometry_at(TimestampNs stamp_ns, double x) {
  nav_msgs::msg::Odometry message;
  dds::to_msg(pose_at(stamp_ns, x), dds::Frame::kMap, message);
  return message;
}

sensor_msgs::msg::Imu imu_at(TimestampNs stamp_ns) {
  ImuSample sample;
  sample.stamp_ns = stamp_ns;
  sensor_msgs::msg::Imu message;
  dds::to_msg(sample, message);
  return message;
}

/// 100 samples; fused poses from the tenth on, but for the fiftieth, each 2 ms after its sample was
/// sent and the last 7 ms; the last stamp's pose comes twice.
void write_walk(Recorded& recorded) {
  for (int i = 0; i < 100; ++i) {
    const TimestampNs stamp = kStart + i * kPeriod;
    const TimestampNs sent = kHost + i * kPeriod;
    recorded.add(topics::kImuRaw, imu_at(stamp), sent, sent + 500'000);
    sensor_msgs::msg::Imu attitude_message;
    AttitudeEstimate attitude;
    attitude.stamp_ns = stamp;
    dds::to_msg(attitude, attitude_message);
    recorded.add(topics::kAttitude, attitude_message, sent, sent + 1'000'000);
    if (i < 9 || i == 49) continue;
    recorded.add(topics::kPdrOdometry, odometry_at(stamp, 0.5 * i), sent, sent + 1'500'000);
    const TimestampNs delay = i == 99 ? 7'000'000 : 2'000'000;
    recorded.add(topics::kFusedOdometry, odometry_at(stamp, i), sent, sent + delay);
  }
  const TimestampNs last = kStart + 99 * kPeriod;
  recorded.add(topics::kFusedOdometry, odometry_at(last, 123.0), kHost, kHost + 2 * kNsPerSecond);
}

TEST(RunExport, GivesARunThatEvaluationReads) {
  const TemporaryFolder folder;
  Recorded recorded(folder.path() / "a.mcap");
  write_walk(recorded);
  vpdr_msgs::msg::Step step_message;
  StepEvent step;
  step.stamp_ns = kStart + kPeriod;
  step.length_m = 0.75;
  step.yaw_rad = 1.5;
  dds::to_msg(step, step_message);
  recorded.add(topics::kStep, step_message, kHost, kHost);
  vpdr_msgs::msg::CorridorHeading heading_message;
  CorridorHeading heading;
  heading.stamp_ns = kStart;
  heading.found = true;
  heading.heading_rad = 0.125;
  heading.sigma_rad = 0.01;
  dds::to_msg(heading, heading_message);
  recorded.add(topics::kCorridorHeading, heading_message, kHost, kHost);
  ASSERT_TRUE(recorded.writer().close());

  const ExportReport report = export_run(folder.path() / "a.mcap", folder.path() / "run");
  EXPECT_EQ(report.incomplete, "");
  EXPECT_EQ(report.unreadable, 0U);
  const auto run = evaluation::RunDirectory::read(folder.path() / "run");
  ASSERT_EQ(run.fused.size(), 90U);
  EXPECT_EQ(run.fused.front().stamp_ns, kStart + 9 * kPeriod);
  EXPECT_DOUBLE_EQ(run.fused.back().position_m.x(), 123.0) << "the later of one stamp counts";
  EXPECT_EQ(run.pdr.size(), 90U);
  EXPECT_EQ(run.attitude.size(), 100U);
  ASSERT_EQ(run.steps.size(), 1U);
  EXPECT_DOUBLE_EQ(run.steps[0].length_m, 0.75);
  ASSERT_EQ(run.vision_heading.size(), 1U);
  EXPECT_DOUBLE_EQ(run.vision_heading[0].heading_rad, 0.125);
  EXPECT_EQ(run.summary.steps, 1U);
  EXPECT_NEAR(run.summary.duration_s, 0.99, 1e-9);
}

TEST(RunExport, LatencyByHand) {
  const TemporaryFolder folder;
  Recorded recorded(folder.path() / "a.mcap");
  write_walk(recorded);
  ASSERT_TRUE(recorded.writer().close());
  const auto report = export_run(folder.path() / "a.mcap", folder.path() / "run");
  ASSERT_EQ(report.info.latencies.size(), 1U);
  const evaluation::LatencyReport& latency = report.info.latencies[0];
  EXPECT_EQ(latency.count, 90U) << "100, less 9 before the first pose and the fiftieth";
  EXPECT_EQ(latency.lost, 1U) << "the fiftieth";
  EXPECT_DOUBLE_EQ(latency.p50_us, 2000.0);
  EXPECT_DOUBLE_EQ(latency.max_us, 7000.0) << "not the second pose of the last stamp";
}

TEST(RunExport, TellsTheRecordersCountsAndTheServicesStates) {
  const TemporaryFolder folder;
  Recorded recorded(folder.path() / "a.mcap");
  write_walk(recorded);
  diagnostic_msgs::msg::DiagnosticArray report;
  report.status().resize(1);
  report.status()[0].name("pdr");
  report.status()[0].message("finished");
  recorded.add(topics::kDiagnostics, report, kHost, kHost);
  mcap::Metadata counters{mcap::kCountersRecord, {}};
  mcap::add_counters("imu/data_raw", {103, 3, 0, 100}, counters.entries);
  ASSERT_TRUE(recorded.writer().write(counters));
  ASSERT_TRUE(recorded.writer().close());
  export_run(folder.path() / "a.mcap", folder.path() / "run", {"by hand", "/walks/one"});
  const auto info = evaluation::read_run_info(folder.path() / "run");
  EXPECT_EQ(info.title, "by hand");
  EXPECT_EQ(info.recording, "/walks/one");
  ASSERT_EQ(info.topics.size(), 5U);
  const auto raw = std::find_if(info.topics.begin(), info.topics.end(),
                                [](const auto& t) { return t.topic == "/ann/imu/data_raw"; });
  ASSERT_NE(raw, info.topics.end());
  EXPECT_EQ(raw->received, 103U);
  EXPECT_EQ(raw->lost, 3U);
  EXPECT_EQ(raw->written, 100U);
  ASSERT_EQ(info.services.size(), 1U);
  EXPECT_EQ(info.services[0].state, "finished");
}

TEST(RunExport, ATornRecordingGivesWhatItHas) {
  const TemporaryFolder folder;
  {
    Recorded recorded(folder.path() / "a.mcap");
    write_walk(recorded);
    ASSERT_TRUE(recorded.writer().close());
  }
  const auto size = std::filesystem::file_size(folder.path() / "a.mcap");
  std::filesystem::resize_file(folder.path() / "a.mcap", size - 20);
  const auto report = export_run(folder.path() / "a.mcap", folder.path() / "run");
  EXPECT_NE(report.incomplete, "");
  EXPECT_EQ(evaluation::RunDirectory::read(folder.path() / "run").fused.size(), 90U);
}

std::string fault_of(const std::filesystem::path& file, const std::filesystem::path& folder) {
  try {
    export_run(file, folder);
  } catch (const FileFault& fault) {
    return fault.what();
  }
  return "no fault";
}

TEST(RunExport, NamesWhatItCannotUse) {
  const TemporaryFolder folder;
  const auto note = folder.write("note.txt", "some text that is no recording");
  EXPECT_NE(fault_of(note, folder.path() / "run").find("is no MCAP"), std::string::npos);
  {
    Recorded only_imu(folder.path() / "imu.mcap");
    only_imu.add(topics::kImuRaw, imu_at(kStart), kHost, kHost);
  }
  EXPECT_NE(fault_of(folder.path() / "imu.mcap", folder.path() / "run").find("holds no pose"),
            std::string::npos);
  {
    Recorded two(folder.path() / "two.mcap");
    two.add(topics::kFusedOdometry, odometry_at(kStart, 0), kHost, kHost, "ann");
    two.add(topics::kFusedOdometry, odometry_at(kStart, 0), kHost, kHost, "bob");
  }
  EXPECT_NE(fault_of(folder.path() / "two.mcap", folder.path() / "run").find("/bob/"),
            std::string::npos);
  {
    const dds::Topic<sensor_msgs::msg::Imu> wrong{
        {topics::kFusedOdometry.info.name, "sensor_msgs/msg/Imu", "fusion", {}}};
    Recorded typed(folder.path() / "type.mcap");
    typed.add(wrong, imu_at(kStart), kHost, kHost);
  }
  EXPECT_NE(fault_of(folder.path() / "type.mcap", folder.path() / "run").find("is of type"),
            std::string::npos);
}

}  // namespace
}  // namespace vpdr::run_export
