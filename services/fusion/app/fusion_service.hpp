#pragma once
// fusion on the network: what pdr and vision estimate in, one pose out.
#include <memory>
#include <mutex>
#include <optional>

#include "app/progress.hpp"
#include "app/service.hpp"
#include "fusion/core/fusion.hpp"
#include "geometry_msgs.h"
#include "nav_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::fusion {

/// Works in the subscriptions' thread. fusion/odometry follows every pdr/odometry; fusion/pose and
/// fusion/state every tenth of a second of sensor time and every step; fusion/path once a second.
class FusionService : public app::Service {
 public:
  FusionService(const FusionConfig& config, app::ServiceContext& context);

  void report(app::Health& health) override;
  [[nodiscard]] std::vector<std::string> upstream() const override {
    return {"imu_gateway", "pdr", "vision"};
  }
  void close() override;

 private:
  template <class Message, class Estimate>
  std::unique_ptr<dds::Subscription<Message>> feed(app::ServiceContext& context,
                                                   const dds::Topic<Message>& topic,
                                                   Estimate& estimate);
  void take(const nav_msgs::msg::Odometry& message);
  void publish_pose(const FusedPose& fused);
  void extend_path(const FusedPose& fused);

  std::mutex mutex_;  ///< guards fusion_ between the listeners and report()
  Fusion fusion_;
  PoseEstimate odometry_;
  HeadingEstimate heading_;
  StepEvent step_;
  HeadingRate rate_;
  CorridorHeading corridor_;
  bool stepped_ = false;
  std::optional<TimestampNs> last_pose_ns_;
  std::optional<TimestampNs> last_path_ns_;

  nav_msgs::msg::Odometry odometry_message_;
  geometry_msgs::msg::PoseWithCovarianceStamped pose_message_;
  vpdr_msgs::msg::FusionState state_message_;
  nav_msgs::msg::Path path_message_;
  std::unique_ptr<dds::Publisher<nav_msgs::msg::Odometry>> odometry_publisher_;
  std::unique_ptr<dds::Publisher<geometry_msgs::msg::PoseWithCovarianceStamped>> pose_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::FusionState>> state_publisher_;
  std::unique_ptr<dds::Publisher<nav_msgs::msg::Path>> path_publisher_;
  app::ProgressReporter progress_;
  // Last, so that no estimate comes before everything above is there.
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Heading>> heading_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Step>> step_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::HeadingRate>> rate_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::CorridorHeading>> corridor_subscription_;
  std::unique_ptr<dds::Subscription<nav_msgs::msg::Odometry>> odometry_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Progress>> pdr_progress_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::fusion
