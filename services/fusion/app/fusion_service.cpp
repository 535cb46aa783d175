#include "fusion/app/fusion_service.hpp"

#include <algorithm>

#include "dds/convert.hpp"
#include "fusion/app/fusion_settings.hpp"

namespace vpdr::fusion {
namespace {

constexpr std::chrono::seconds kHandOverTimeout{5};
constexpr TimestampNs kPosePeriodNs = kNsPerSecond / 10;
/// The path grows with the walk and is sent whole: the longer it is, the rarer.
constexpr TimestampNs kPathPeriodNs = kNsPerSecond;
constexpr TimestampNs kPathPeriodPerPointNs = 2'000'000;

bool due(std::optional<TimestampNs>& last, TimestampNs now, TimestampNs period) {
  if (last && now >= *last && now - *last < period) return false;
  last = now;
  return true;
}

constexpr const char* kInputNames[kInputCount] = {"odometry", "heading", "step", "rate",
                                                  "corridor"};

}  // namespace

FusionService::FusionService(const FusionConfig& config, app::ServiceContext& context)
    : fusion_(config),
      odometry_publisher_(context.advertise(dds::topics::kFusedOdometry)),
      pose_publisher_(context.advertise(dds::topics::kFusedPose)),
      state_publisher_(context.advertise(dds::topics::kFusionState)),
      path_publisher_(context.advertise(dds::topics::kPath)),
      progress_(context) {
  path_message_.header().frame_id(dds::name_of(dds::Frame::kMap));
  heading_subscription_ = feed(context, dds::topics::kHeading, heading_);
  step_subscription_ = feed(context, dds::topics::kStep, step_);
  rate_subscription_ = feed(context, dds::topics::kHeadingRate, rate_);
  corridor_subscription_ = feed(context, dds::topics::kCorridorHeading, corridor_);
  odometry_subscription_ = context.subscribe(
      dds::topics::kPdrOdometry,
      [this](const nav_msgs::msg::Odometry& m, const dds::SampleInfo&) { take(m); });
  pdr_progress_ =
      app::subscribe_progress(context, "pdr", [this](TimestampNs stamp) { progress_.done(stamp); });
}

template <class Message, class Estimate>
std::unique_ptr<dds::Subscription<Message>> FusionService::feed(app::ServiceContext& context,
                                                                const dds::Topic<Message>& topic,
                                                                Estimate& estimate) {
  return context.subscribe(topic,
                           [this, &estimate](const Message& message, const dds::SampleInfo&) {
                             const std::lock_guard lock(mutex_);
                             dds::from_msg(message, estimate);
                             fusion_.process(estimate);
                             if constexpr (std::is_same_v<Estimate, StepEvent>) {
                               stepped_ = stepped_ || estimate.status == StepStatus::kConfirmed;
                             }
                           });
}

void FusionService::take(const nav_msgs::msg::Odometry& message) {
  const std::lock_guard lock(mutex_);
  dds::from_msg(message, odometry_);
  if (fusion_.process(odometry_) != Refusal::kNone) return;
  const std::optional<FusedPose> fused = fusion_.latest();
  if (!fused) return;
  dds::to_msg(fused->pose, dds::Frame::kMap, odometry_message_);
  odometry_publisher_->publish(odometry_message_);
  if (due(last_pose_ns_, fused->pose.stamp_ns, kPosePeriodNs) || stepped_) publish_pose(*fused);
  if (stepped_) extend_path(*fused);
  stepped_ = false;
}

void FusionService::publish_pose(const FusedPose& fused) {
  dds::to_msg(fused.pose, dds::Frame::kMap, pose_message_);
  pose_publisher_->publish(pose_message_);
  dds::to_msg(fused, state_message_);
  state_publisher_->publish(state_message_);
}

void FusionService::extend_path(const FusedPose& fused) {
  auto& points = path_message_.poses();
  dds::to_msg(fused.pose, dds::Frame::kMap, points.emplace_back());
  const auto growth = static_cast<TimestampNs>(points.size()) * kPathPeriodPerPointNs;
  if (!due(last_path_ns_, fused.pose.stamp_ns, std::max(kPathPeriodNs, growth))) return;
  dds::to_msg(fused.pose.stamp_ns, path_message_.header().stamp());
  path_publisher_->publish(path_message_);
}

void FusionService::report(app::Health& health) {
  const std::lock_guard lock(mutex_);
  const FusionDiagnostics d = fusion_.diagnostics();
  health.note("mode", name_of(d.mode));
  for (std::size_t i = 0; i < kInputCount; ++i) {
    const std::string name = kInputNames[i];
    health.count(name + ".accepted", d.inputs[i].accepted());
    health.count_refusals(name, d.inputs[i]);
  }
  health.count("steps", d.steps);
  health.count("reapplied", d.reapplied);
  health.count("odometry.lost", odometry_subscription_->counts().lost);
  // Where nothing else goes on either, no stamp tells that pdr is gone.
  const bool left =
      odometry_subscription_->counts().received > 0 && odometry_subscription_->alive_count() == 0;
  if (left || d.mode == FusionMode::kCoasting) {
    health.degrade("pdr is silent, the pose is held", "look at pdr and imu_gateway");
  }
}

void FusionService::close() {
  {
    const std::lock_guard lock(mutex_);
    if (!path_message_.poses().empty()) path_publisher_->publish(path_message_);
    // What vision said last may have moved the pose after pdr's last odometry.
    if (const auto fused = fusion_.latest()) {
      dds::to_msg(fused->pose, dds::Frame::kMap, odometry_message_);
      odometry_publisher_->publish(odometry_message_);
      publish_pose(*fused);
    }
  }
  odometry_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  pose_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  state_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  path_publisher_->wait_for_acknowledgments(kHandOverTimeout);
}

app::ServiceEntry service_entry() {
  auto config = std::make_shared<FusionConfig>();
  app::ServiceEntry entry;
  entry.name = "fusion";
  entry.summary = "One pose with its covariance out of all that pdr and vision say.";
  entry.bind = [config](config::Binder& binder) { bind(binder, *config); };
  entry.make = [config](app::ServiceContext& context) {
    return std::make_unique<FusionService>(*config, context);
  };
  return entry;
}

}  // namespace vpdr::fusion
