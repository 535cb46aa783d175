#include "run_export/run_export.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "dds/convert.hpp"
#include "diagnostic_msgs.h"
#include "evaluation/run_writer.hpp"
#include "geometry_msgs.h"
#include "mcap/reader.hpp"
#include "mcap/topic_counters.hpp"
#include "nav_msgs.h"
#include "run_export/imu_times.hpp"
#include "run_export/topic_dispatch.hpp"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::run_export {
namespace {

namespace topics = dds::topics;

constexpr double kUsPerNs = 1e-3;

/// Everything but the file's own affairs: rows out, latencies gathered.
class Exporter {
 public:
  Exporter(const mcap::Reader& reader, std::string file, const std::filesystem::path& folder)
      : reader_(reader),
        file_(std::move(file)),
        dispatch_(reader, file_),
        writer_(folder, {.vision_heading = dispatch_.has(topics::kCorridorHeading.info)}) {}

  TopicDispatch::Counts run();
  void finish();

  [[nodiscard]] std::uint64_t left_out() const { return writer_.left_out(); }
  evaluation::LatencyReport latency() {
    return evaluation::summarize_latency("IMU sample to fused pose", std::move(latencies_us_),
                                         imu_times_.unanswered());
  }
  [[nodiscard]] std::vector<evaluation::ServiceInfo> services() const;

 private:
  void read_imu_times();
  void follow_fusion();
  void follow_pdr();
  void follow_states();
  void take_fused(const PoseEstimate& pose, TimestampNs log_time_ns);

  const mcap::Reader& reader_;
  std::string file_;
  TopicDispatch dispatch_;
  evaluation::RunWriter writer_;
  ImuTimes imu_times_;
  std::optional<PoseEstimate> fused_;  ///< held back: a later one of the same stamp replaces it
  std::optional<TimestampNs> first_fused_log_ns_;
  TimestampNs last_fused_log_ns_ = 0;
  std::vector<double> latencies_us_;
  std::map<std::string, std::string> states_;
};

void Exporter::read_imu_times() {
  TopicDispatch samples(reader_, file_);
  samples.on(topics::kImuRaw, [this](const sensor_msgs::msg::Imu& imu, const mcap::Message& raw) {
    imu_times_.add(dds::from_msg(imu.header().stamp()), raw.publish_time_ns);
  });
  samples.run();
  imu_times_.sort();
}

void Exporter::take_fused(const PoseEstimate& pose, TimestampNs log_time_ns) {
  if (fused_ && fused_->stamp_ns != pose.stamp_ns) writer_.add_fused(*fused_);
  fused_ = pose;
  if (!first_fused_log_ns_) first_fused_log_ns_ = log_time_ns;
  last_fused_log_ns_ = log_time_ns;
  if (const auto sent = imu_times_.answer(pose.stamp_ns)) {
    latencies_us_.push_back(static_cast<double>(log_time_ns - *sent) * kUsPerNs);
  }
}

void Exporter::follow_fusion() {
  const auto take = [this](const auto& message, const mcap::Message& raw) {
    PoseEstimate pose;
    dds::from_msg(message, pose);
    take_fused(pose, raw.log_time_ns);
  };
  if (dispatch_.has(topics::kFusedOdometry.info)) return dispatch_.on(topics::kFusedOdometry, take);
  if (dispatch_.has(topics::kFusedPose.info)) return dispatch_.on(topics::kFusedPose, take);
  if (!dispatch_.has(topics::kPdrOdometry.info)) {
    throw FileFault(
        file_ + ": holds no pose: " +
        (dispatch_.has(topics::kImuRaw.info)
             ? "neither fusion/odometry nor pdr/odometry came; were pdr and fusion running?"
             : "no inertial sample came; the log of imu_gateway says why"));
  }
}

void Exporter::follow_pdr() {
  dispatch_.on(topics::kPdrOdometry, [this](const auto& message, const mcap::Message&) {
    PoseEstimate pose;
    dds::from_msg(message, pose);
    writer_.add_pdr(pose);
  });
  dispatch_.on(topics::kAttitude, [this](const auto& message, const mcap::Message&) {
    AttitudeEstimate attitude;
    dds::from_msg(message, attitude);
    writer_.add_attitude(attitude);
  });
  dispatch_.on(topics::kStep, [this](const auto& message, const mcap::Message&) {
    StepEvent step;
    dds::from_msg(message, step);
    writer_.add_step(step);
  });
  dispatch_.on(topics::kVisionOdometry, [this](const auto& message, const mcap::Message&) {
    PoseEstimate pose;
    dds::from_msg(message, pose);
    writer_.add_vision(pose);
  });
  dispatch_.on(topics::kCorridorHeading, [this](const auto& message, const mcap::Message&) {
    CorridorHeading heading;
    dds::from_msg(message, heading);
    writer_.add_vision_heading(heading);
  });
}

void Exporter::follow_states() {
  dispatch_.on(topics::kDiagnostics, [this](const auto& message, const mcap::Message&) {
    for (const auto& status : message.status()) states_[status.name()] = status.message();
  });
}

TopicDispatch::Counts Exporter::run() {
  read_imu_times();
  follow_fusion();
  follow_pdr();
  follow_states();
  return dispatch_.run();
}

void Exporter::finish() {
  if (fused_) writer_.add_fused(*fused_);
  evaluation::Summary summary;
  summary.duration_s = imu_times_.duration_s();
  const double took_s = to_seconds(last_fused_log_ns_ - first_fused_log_ns_.value_or(0));
  if (took_s > 0.0) summary.speed_factor = summary.duration_s / took_s;
  writer_.finish(summary);
}

std::vector<evaluation::ServiceInfo> Exporter::services() const {
  std::vector<evaluation::ServiceInfo> list;
  for (const auto& [name, state] : states_) list.push_back({name, "", state, ""});
  return list;
}

/// The recorder's counts; in a torn file, which has none, the messages that are there.
std::vector<evaluation::TopicCount> topic_counts(const mcap::Reader& reader) {
  const mcap::Contents& contents = reader.contents();
  mcap::StringMap entries;
  for (const mcap::Metadata& record : contents.metadata) {
    if (record.name == mcap::kCountersRecord) entries = record.entries;
  }
  std::vector<evaluation::TopicCount> counts;
  for (const auto& [id, channel] : contents.channels) {
    const mcap::Schema* schema = reader.schema_of(channel);
    const auto found = contents.statistics.channel_message_counts.find(id);
    const bool any = found != contents.statistics.channel_message_counts.end();
    const std::uint64_t written = any ? found->second : 0;
    const auto counters = mcap::find_counters(name_without_walker(channel.topic), entries);
    counts.push_back({channel.topic, schema == nullptr ? "" : schema->name,
                      counters ? counters->received : written, counters ? counters->lost : 0,
                      written});
  }
  std::sort(counts.begin(), counts.end(),
            [](const auto& a, const auto& b) { return a.topic < b.topic; });
  return counts;
}

}  // namespace

ExportReport export_run(const std::filesystem::path& file, const std::filesystem::path& folder,
                        const ExportOptions& options) {
  const Result<mcap::Reader> opened = mcap::Reader::open(file);
  if (!opened) throw FileFault(opened.error().message);
  const mcap::Reader& reader = opened.value();
  ExportReport report;
  Exporter exporter(reader, file.string(), folder);
  const TopicDispatch::Counts counts = exporter.run();
  exporter.finish();
  report.messages = counts.messages;
  report.unreadable = counts.unreadable;
  report.damaged_chunks = counts.damaged_chunks + reader.contents().damage.size();
  report.left_out = exporter.left_out();
  report.info.latencies.push_back(exporter.latency());
  report.info.services = exporter.services();
  report.incomplete = reader.contents().incomplete;
  report.info.title = options.title;
  report.info.recording = options.recording;
  report.info.topics = topic_counts(reader);
  evaluation::write_run_info(folder, report.info);
  return report;
}

}  // namespace vpdr::run_export
