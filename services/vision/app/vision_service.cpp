#include "vision/app/vision_service.hpp"

#include <spdlog/spdlog.h>

#include <opencv2/core/utility.hpp>

#include "dds/convert.hpp"
#include "vision/app/vision_settings.hpp"

namespace vpdr::vision {
namespace {

/// A live frame whose attitude does not come within this is looked at without.
constexpr std::chrono::milliseconds kAttitudePatience{100};
/// When pdr is so far ahead of its own attitudes, none are coming: playback must not wait for us.
constexpr TimestampNs kAttitudeLagNs = 250'000'000;

}  // namespace

VisionService::VisionService(const AnalysisConfig& config, const SourceSettings& settings,
                             app::ServiceContext& context)
    : opened_(open_frames(settings, context)),
      processor_(context, settings.publish_images),
      progress_(context),
      track_(config.heading.attitude) {
  // One core is what a frame needs; helpers that wake for each of its steps only cost.
  cv::setNumThreads(1);
  if (opened_.camera) {
    processor_.set_camera(config, *opened_.camera);
  } else {
    spdlog::warn("{}{}{}", opened_.idle_reason, opened_.idle_remedy.empty() ? "" : "; ",
                 opened_.idle_remedy);
  }
  attitude_subscription_ = context.subscribe(
      dds::topics::kAttitude,
      [this](const sensor_msgs::msg::Imu& m, const dds::SampleInfo&) { take(m); });
  step_subscription_ = context.subscribe(
      dds::topics::kStep,
      [this](const vpdr_msgs::msg::Step& m, const dds::SampleInfo&) { take_step(m); });
  pdr_progress_ =
      app::subscribe_progress(context, "pdr", [this](TimestampNs stamp) { pass_on(stamp); });
}

VisionService::~VisionService() { close(); }

void VisionService::start() {
  if (!opened_.live) return;
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  search_thread_ = std::jthread([this](const std::stop_token& stop) { search_headings(stop); });
}

void VisionService::take(const sensor_msgs::msg::Imu& message) {
  {
    const std::lock_guard lock(mutex_);
    dds::from_msg(message, attitude_);
    track_.add(attitude_);
    changed_.notify_all();
  }
  release_due_frames();
  progress_.done(attitude_.stamp_ns);
}

void VisionService::take_step(const vpdr_msgs::msg::Step& message) {
  StepEvent step;
  dds::from_msg(message, step);
  processor_.add(step);
}

// Only the subscription's thread adds to the track, so it may read it without the lock.
void VisionService::release_due_frames() {
  if (!opened_.recorded) return;
  for (auto next = opened_.recorded->next_stamp(); next && track_.is_due(*next);
       next = opened_.recorded->next_stamp()) {
    processor_.process(opened_.recorded->load(), track_.at(*next));
  }
}

void VisionService::pass_on(TimestampNs pdr_done_ns) {
  const auto newest = track_.newest_ns();
  if (!newest || pdr_done_ns - *newest > kAttitudeLagNs) progress_.done(pdr_done_ns);
}

void VisionService::watch(const std::stop_token& stop) {
  while (const auto frame = opened_.live->take(stop)) {
    const auto attitude = await_attitude(frame->stamp_ns, stop);
    if (processor_.heading_is_due(frame->stamp_ns)) {
      const std::lock_guard lock(search_mutex_);
      search_ = Search{*frame, attitude};
      search_changed_.notify_one();
    }
    processor_.look_for_motion(*frame, attitude);
  }
}

void VisionService::search_headings(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(search_mutex_);
    if (!search_changed_.wait(lock, stop, [&] { return search_.has_value(); })) return;
    const Search next = std::move(*search_);
    search_.reset();
    lock.unlock();
    processor_.look_for_heading(next.frame, next.attitude);
  }
}

std::optional<AttitudePrior> VisionService::await_attitude(TimestampNs stamp_ns,
                                                           const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, kAttitudePatience, [&] { return track_.is_due(stamp_ns); });
  return track_.at(stamp_ns);
}

void VisionService::report(app::Health& health) {
  if (!opened_.idle_reason.empty()) {
    health.note("idle", opened_.idle_reason);
    if (!opened_.idle_remedy.empty()) health.degrade(opened_.idle_reason, opened_.idle_remedy);
  }
  processor_.report(health);
  const dds::ReaderCounts counts = attitude_subscription_->counts();
  health.count("attitude.received", counts.received);
  health.count("attitude.lost", counts.lost);
  if (opened_.live) {
    const LiveHealth camera = opened_.live->health();
    health.count("camera.frames", camera.frames);
    health.count("camera.dropped", camera.dropped);
    health.count("camera.reconnections", camera.reconnections);
    if (!camera.connected) {
      health.degrade("the camera gives no frames",
                     "plug it in, start who publishes it, or look at vision.camera");
    }
  }
  if (counts.received > 0 && attitude_subscription_->alive_count() == 0) {
    health.degrade("pdr is silent, the vertical is searched in the images", "start pdr again");
  }
}

void VisionService::close() {
  for (std::jthread* thread : {&thread_, &search_thread_}) {
    if (!thread->joinable()) continue;
    thread->request_stop();
    thread->join();
  }
  processor_.close();
}

app::ServiceEntry service_entry() {
  struct Settings {
    AnalysisConfig config;
    SourceSettings source;
  };
  auto settings = std::make_shared<Settings>();
  app::ServiceEntry entry;
  entry.name = "vision";
  entry.summary = "Heading relative to the corridor, its rate, and metric motion from a camera.";
  entry.bind = [settings](config::Binder& binder) {
    bind(binder, settings->source);
    bind(binder, settings->config);
  };
  entry.shortcuts = {{"--recording", "recording", "folder of a recorded walk"},
                     {"--camera", "camera.source", "live camera: index, device or URL"},
                     {"--calibration", "calibration", "camera calibration file"},
                     {"--seed", "simulation.seed", "seed of the simulated walk"},
                     {"--duration", "simulation.duration_s", "length of the simulated walk, s"}};
  entry.flags = {{"--simulate", "simulation.enabled", "look at a simulated walk"},
                 {"--from-topic", "camera.from_topic", "look at camera/image/compressed"}};
  entry.make = [settings](app::ServiceContext& context) {
    return std::make_unique<VisionService>(settings->config, settings->source, context);
  };
  return entry;
}

}  // namespace vpdr::vision
