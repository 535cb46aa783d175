#include "recorder/app/recorder_service.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <system_error>
#include <utility>

#include "dds/schema.hpp"
#include "recorder/core/header_stamp.hpp"

namespace vpdr::recorder {
namespace {

constexpr std::chrono::milliseconds kDiscoveryWait{200};

mcap::StringMap walk_record(const RecorderSettings& settings, const app::CommonSettings& common) {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return {{"walker", common.walker},
          {"domain", std::to_string(common.domain)},
          {"host", host.data()},
          {"idl_hash", std::string(dds::idl_hash())},
          {"chunk_kib", std::to_string(settings.chunk_kib)},
          {"chunk_s", std::to_string(settings.chunk_s)},
          {"compression_level", std::to_string(settings.compression_level)}};
}

}  // namespace

RecorderService::RecorderService(const RecorderSettings& settings, app::ServiceContext& context)
    : settings_(settings),
      context_(context),
      progress_(context),
      file_(settings, recording_path(settings, context.common().walker), topics_,
            walk_record(settings, context.common()),
            [&context](const std::string& message) {
              context.request_stop(ExitCode::kFile, message);
            }),
      discovery_([this](const std::stop_token& stop) { follow_discovery(stop); }) {
  spdlog::info("recording to {}", file_.path().string());
}

RecorderService::~RecorderService() { close(); }

void RecorderService::follow_discovery(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    for (const dds::WriterEvent& event :
         context_.participant().take_writer_events(kDiscoveryWait)) {
      if (event.appeared) consider(event.writer);
    }
  }
}

void RecorderService::consider(const dds::WriterInfo& writer) {
  const auto topic = dds::parse_topic_path(writer.topic);
  if (!topic || topic->walker != context_.common().walker) return;
  if (!subscriptions_.contains(topic->name)) return subscribe(topic->name, writer);
  for (const TopicRow& row : topics_.rows()) {
    if (row.description.name != topic->name) continue;
    const dds::WriterInfo& asked = row.description.writer;
    const bool weaker =
        (asked.reliable && !writer.reliable) || (asked.transient_local && !writer.transient_local);
    if (!weaker || !weaker_topics_.insert(topic->name).second) continue;
    spdlog::error(
        "{}: {} offers less reliability or durability than the topic's first writer ({}) and is "
        "not recorded: give both the same quality of service",
        writer.topic, writer.participant, asked.participant);
  }
}

void RecorderService::subscribe(const std::string& name, const dds::WriterInfo& writer) {
  const std::size_t topic = topics_.add({name, writer});
  // Playback goes no further ahead than the samples that the recorder has taken.
  const bool paces = name == dds::topics::kImuRaw.info.name;
  try {
    subscriptions_.emplace(
        name, dds::RawSubscription(context_.participant(), writer,
                                   [this, topic, paces](std::span<const std::byte> payload,
                                                        const dds::SampleInfo& info) {
                                     take(topic, paces, payload, info);
                                   }));
    spdlog::info("topic {} of type {}", writer.topic, writer.type);
  } catch (const DdsFault& fault) {
    spdlog::error("{}: not recorded: {}", writer.topic, fault.what());
  }
}

void RecorderService::take(std::size_t topic, bool paces, std::span<const std::byte> payload,
                           const dds::SampleInfo& info) {
  topics_.received(topic, info, payload.size());
  QueuedSample sample;
  sample.topic = topic;
  sample.sequence = static_cast<std::uint32_t>(info.sequence_number);
  sample.log_time_ns = info.reception_timestamp_ns;
  // A writer that sends no time: what is known is when it came.
  sample.publish_time_ns =
      info.source_timestamp_ns > 0 ? info.source_timestamp_ns : info.reception_timestamp_ns;
  file_.queue().push(sample, payload);
  if (!paces) return;
  if (const auto stamp = header_stamp(payload)) progress_.done(*stamp);
}

void RecorderService::report_space(app::Health& health) {
  std::error_code error;
  const auto space =
      std::filesystem::space(std::filesystem::absolute(file_.path()).parent_path(), error);
  if (error) return;
  const std::uint64_t free_mib = space.available >> 20U;
  health.count("disk.free_mib", free_mib);
  if (free_mib < settings_.low_space_mib) {
    health.degrade(
        "only " + std::to_string(free_mib) + " MiB are free for " + file_.path().string(),
        "free some space: when the disk is full the recording ends");
  }
}

void RecorderService::report(app::Health& health) {
  const std::vector<TopicRow> rows = topics_.rows();
  const TopicStatistics sum = total(rows);
  if (file_.failed()) {
    health.degrade("the recording has ended: " + file_.path().string() + " could not be written",
                   "see the log of the recorder");
  }
  if (const std::uint64_t lost = losses_.update(sum.lost); lost > 0) {
    health.degrade(std::to_string(lost) + " samples were lost on the way in the last 10 s",
                   "look at the network and at the load of this host");
  }
  if (waits_.update(file_.queue().waits()) > 0) {
    health.degrade("the disk is slower than the samples come",
                   "record to a faster disk, or set recorder.sync to on_close");
  }
  report_space(health);
  health.note("file", file_.path().string());
  health.count("file.bytes", file_.bytes_in_file());
  health.count("topics", rows.size());
  health.count("received", sum.received);
  health.count("lost", sum.lost);
  health.count("before", sum.before);
  health.count("written", sum.written);
  health.count("queue.waits", file_.queue().waits());
  for (const TopicRow& row : rows) {
    const std::string& name = row.description.name;
    health.count(name + ".received", row.statistics.received);
    health.count(name + ".lost", row.statistics.lost);
    health.count(name + ".written", row.statistics.written);
  }
}

void RecorderService::close() {
  if (!discovery_.joinable()) return;
  discovery_.request_stop();
  discovery_.join();
  // Writing goes on meanwhile: a callback that waits for room in the queue gets it.
  subscriptions_.clear();
  file_.finish();
  const TopicStatistics sum = total(topics_.rows());
  spdlog::info("{}: {} samples of {} topics, {} lost, {} bytes", file_.path().string(), sum.written,
               topics_.size(), sum.lost, file_.bytes_in_file());
}

app::ServiceEntry service_entry() {
  auto settings = std::make_shared<RecorderSettings>();
  app::ServiceEntry entry;
  entry.name = "recorder";
  entry.summary =
      "Records every topic of a walker to an MCAP file. `recorder info FILE` tells what a "
      "recording holds.";
  entry.bind = [settings](config::Binder& binder) { bind(binder, *settings); };
  entry.shortcuts = {{"--out", "file", "recording to write; one that exists is refused"}};
  entry.flags = {{"--replace", "replace", "remove a recording of that name first"}};
  entry.make = [settings](app::ServiceContext& context) {
    return std::make_unique<RecorderService>(*settings, context);
  };
  return entry;
}

}  // namespace vpdr::recorder
