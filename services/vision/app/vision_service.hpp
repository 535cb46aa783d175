#pragma once
// vision on the network: attitudes of the body in, frames from a camera or a recording, heading
// relative to the corridor and its rate out.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/progress.hpp"
#include "app/service.hpp"
#include "sensor_msgs.h"
#include "vision/app/frame_processor.hpp"
#include "vision/app/make_source.hpp"

namespace vpdr::vision {

/// Recorded frames are released by sensor time: each waits for the first attitude at or after its
/// stamp and is then processed in the subscription's thread, so that an acknowledged attitude is
/// one whose frames are done, and what comes out depends on stamps only. A live camera has a
/// thread, which takes the newest frame and waits a moment for its attitude.
class VisionService : public app::Service {
 public:
  VisionService(const VisionConfig& config, const SourceSettings& settings,
                app::ServiceContext& context);
  ~VisionService() override;

  void start() override;
  void report(app::Health& health) override;
  [[nodiscard]] std::vector<std::string> upstream() const override {
    return {"imu_gateway", "pdr"};
  }
  void close() override;

 private:
  void take(const sensor_msgs::msg::Imu& message);
  void release_due_frames();
  void pass_on(TimestampNs pdr_done_ns);
  void watch(const std::stop_token& stop);
  std::optional<AttitudePrior> await_attitude(TimestampNs stamp_ns, const std::stop_token& stop);

  OpenedFrames opened_;
  FrameProcessor processor_;
  app::ProgressReporter progress_;
  std::mutex mutex_;  ///< guards track_
  std::condition_variable_any changed_;
  AttitudeTrack track_;
  AttitudeEstimate attitude_;
  std::jthread thread_;
  // Last, so that no attitude comes before everything above is there.
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::Imu>> attitude_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Progress>> pdr_progress_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::vision
