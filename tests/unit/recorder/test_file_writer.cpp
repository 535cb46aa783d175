#include <gtest/gtest.h>

#include <future>

#include "core/errors.hpp"
#include "mcap/reader.hpp"
#include "mcap/topic_counters.hpp"
#include "recorder/app/file_writer.hpp"
#include "recorder/app/qos_profile.hpp"
#include "recorder/app/recording_info.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::recorder {
namespace {

using vpdr::testing::FileSizeLimit;
using vpdr::testing::TemporaryFolder;

dds::WriterInfo writer_of(const std::string& name, const std::string& type) {
  dds::WriterInfo writer;
  writer.topic = "rt/ann/" + name;
  writer.type = type;
  return writer;
}

class Recording : public ::testing::Test {
 protected:
  std::unique_ptr<FileWriter> make(const std::string& name = "a.mcap") {
    return std::make_unique<FileWriter>(settings_, folder_.path() / name, topics_,
                                        mcap::StringMap{{"walker", "ann"}},
                                        [this](const std::string& message) {
                                          failures_.push_back(message);
                                          failed_.set_value();
                                        });
  }
  /// As the recorder does with a sample that arrives.
  void receive(FileWriter& writer, std::size_t topic, std::uint32_t sequence,
               std::size_t size = 10) {
    const std::vector<std::byte> payload(size, static_cast<std::byte>(sequence));
    dds::SampleInfo info;
    info.reception_timestamp_ns = kNsPerSecond + sequence * 1'000'000LL;
    info.sequence_number = sequence;
    topics_.received(topic, info, size);
    QueuedSample sample;
    sample.topic = topic;
    sample.sequence = sequence;
    sample.log_time_ns = info.reception_timestamp_ns;
    sample.publish_time_ns = sample.log_time_ns - 10;
    writer.queue().push(sample, payload);
  }

  TemporaryFolder folder_;
  RecorderSettings settings_;
  TopicTable topics_;
  std::vector<std::string> failures_;
  std::promise<void> failed_;
};

TEST_F(Recording, HoldsEverySampleWithItsTopicAndType) {
  auto writer = make("new/folder/a.mcap");
  const std::size_t imu =
      topics_.add({"imu/data_raw", writer_of("imu/data_raw", "sensor_msgs/msg/Imu")});
  const std::size_t foreign = topics_.add({"battery", writer_of("battery", "acme_msgs/msg/Cell")});
  const std::size_t silent = topics_.add({"pdr/step", writer_of("pdr/step", "vpdr_msgs/msg/Step")});
  for (std::uint32_t i = 1; i <= 500; ++i) receive(*writer, imu, i);
  receive(*writer, foreign, 4);
  writer->finish();
  EXPECT_TRUE(failures_.empty());
  EXPECT_EQ(topics_.rows()[imu].statistics.written, 500U);
  EXPECT_EQ(topics_.rows()[foreign].statistics.before, 3U) << "it began with its fourth";
  EXPECT_EQ(topics_.rows()[silent].statistics.written, 0U);

  const auto opened = mcap::Reader::open(folder_.path() / "new/folder/a.mcap");
  ASSERT_TRUE(opened) << opened.error().message;
  const mcap::Reader& reader = opened.value();
  EXPECT_TRUE(reader.contents().incomplete.empty());
  ASSERT_EQ(reader.contents().channels.size(), 3U);
  const mcap::Channel& channel = reader.contents().channels.at(1);
  EXPECT_EQ(channel.topic, "/ann/imu/data_raw");
  EXPECT_EQ(channel.message_encoding, "cdr");
  EXPECT_NE(channel.metadata.at("offered_qos_profiles").find("reliability: 1"), std::string::npos);
  const mcap::Schema* schema = reader.schema_of(channel);
  EXPECT_EQ(schema->encoding, "ros2msg");
  EXPECT_NE(schema->text.find("geometry_msgs/Vector3 angular_velocity"), std::string::npos);
  const mcap::Schema* unknown = reader.schema_of(reader.contents().channels.at(2));
  EXPECT_EQ(unknown->name, "acme_msgs/msg/Cell");
  EXPECT_EQ(unknown->encoding, "");
  mcap::MessageStream stream(reader);
  const auto first = stream.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sequence, 1U);
  EXPECT_EQ(first->log_time_ns - first->publish_time_ns, 10);
}

TEST_F(Recording, InfoTellsWhatItHolds) {
  auto writer = make();
  const std::size_t imu =
      topics_.add({"imu/data_raw", writer_of("imu/data_raw", "sensor_msgs/msg/Imu")});
  for (std::uint32_t i = 1; i <= 101; ++i) receive(*writer, imu, i, 20);
  writer->finish();
  const RecordingInfo info = inspect(folder_.path() / "a.mcap");
  ASSERT_EQ(info.topics.size(), 1U);
  EXPECT_EQ(info.walker, "ann");
  EXPECT_EQ(info.topics[0].messages, 101U);
  EXPECT_EQ(info.topics[0].bytes, 2020U);
  EXPECT_DOUBLE_EQ(info.topics[0].rate_hz(), 1000.0);
  EXPECT_DOUBLE_EQ(info.duration_s(), 0.1);
  EXPECT_EQ(info.topics[0].counters->received, 101U);
  const std::string text = to_text(info);
  EXPECT_NE(text.find("complete"), std::string::npos) << text;
  EXPECT_NE(text.find("/ann/imu/data_raw"), std::string::npos);
  EXPECT_NE(to_json(info).find("\"lost\": 0"), std::string::npos) << to_json(info);
}

TEST_F(Recording, InfoTellsWhereATornOneStops) {
  auto writer = make();
  const std::size_t imu =
      topics_.add({"imu/data_raw", writer_of("imu/data_raw", "sensor_msgs/msg/Imu")});
  for (std::uint32_t i = 1; i <= 3000; ++i) receive(*writer, imu, i);
  writer->finish();
  const auto whole = inspect(folder_.path() / "a.mcap");
  const mcap::Segment last = whole.contents.segments.back();
  std::filesystem::resize_file(folder_.path() / "a.mcap", last.offset + 30);
  const RecordingInfo torn = inspect(folder_.path() / "a.mcap");
  EXPECT_LT(torn.topics[0].messages, 3000U);
  EXPECT_GE(torn.topics[0].messages, 2000U) << "a chunk spans a second at most";
  EXPECT_FALSE(torn.topics[0].counters);
  EXPECT_NE(to_text(torn).find("torn: the file ends inside a chunk at byte " +
                               std::to_string(last.offset) + "; the last 30 B cannot be read"),
            std::string::npos)
      << to_text(torn);
}

TEST_F(Recording, InfoOfAnythingElseIsAFileFault) {
  const auto other = folder_.write("note.txt", "no recording at all, only some text");
  EXPECT_THROW(inspect(other), FileFault);
  EXPECT_THROW(inspect(folder_.path() / "absent.mcap"), FileFault);
}

TEST_F(Recording, RefusesAFileThatIsThereUnlessItMayReplaceIt) {
  make()->finish();
  const auto size = std::filesystem::file_size(folder_.path() / "a.mcap");
  try {
    make();
    FAIL() << "an old recording was opened for writing";
  } catch (const FileFault& fault) {
    EXPECT_NE(std::string(fault.what()).find("a.mcap"), std::string::npos);
    EXPECT_NE(std::string(fault.what()).find("--replace"), std::string::npos);
  }
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "a.mcap"), size);
  settings_.replace = true;
  EXPECT_NO_THROW(make()->finish());
}

TEST_F(Recording, AFullDiskIsToldOnceAndHoldsNobodyUp) {
  settings_.compression_level = 0;
  settings_.chunk_kib = 4;
  settings_.queue_mib = 1;
  settings_.sync = mcap::SyncPolicy::kNever;
  const FileSizeLimit full(64 << 10);
  auto writer = make();
  const std::size_t imu =
      topics_.add({"imu/data_raw", writer_of("imu/data_raw", "sensor_msgs/msg/Imu")});
  // More than the disk and the queue hold together: this returns only because samples are dropped.
  for (std::uint32_t i = 1; i <= 3000; ++i) receive(*writer, imu, i, 1000);
  failed_.get_future().wait();
  writer->finish();
  ASSERT_EQ(failures_.size(), 1U);
  EXPECT_NE(failures_[0].find("a.mcap: cannot write"), std::string::npos) << failures_[0];
  EXPECT_NE(failures_[0].find("free some space"), std::string::npos) << failures_[0];
  const RecordingInfo info = inspect(folder_.path() / "a.mcap");
  EXPECT_GT(info.topics.at(0).messages, 40U);
  EXPECT_LT(info.topics.at(0).messages, 64U);
  EXPECT_EQ(topics_.rows()[imu].statistics.written, info.topics[0].messages);
  EXPECT_EQ(topics_.rows()[imu].statistics.received, 3000U);
  if (info.contents.incomplete.empty()) {
    EXPECT_NE(to_text(info).find("ended early"), std::string::npos) << to_text(info);
  }
}

TEST(QosProfile, HasTheValuesThatRosbag2Gives) {
  dds::WriterInfo writer;
  writer.reliable = false;
  writer.transient_local = true;
  const std::string yaml = offered_qos_profiles(writer);
  EXPECT_NE(yaml.find("  reliability: 2\n"), std::string::npos) << "best effort";
  EXPECT_NE(yaml.find("  durability: 1\n"), std::string::npos) << "transient local";
}

}  // namespace
}  // namespace vpdr::recorder
