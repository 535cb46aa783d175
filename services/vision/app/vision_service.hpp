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
/// thread, which takes the newest frame and waits a moment for its attitude, and another one for
/// the vanishing points of the frames that are due, so that tracking does not wait for them.
class VisionService : public app::Service {
 public:
  VisionService(const AnalysisConfig& config, const SourceSettings& settings,
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
  void take_step(const vpdr_msgs::msg::Step& message);
  void watch(const std::stop_token& stop);
  void search_headings(const std::stop_token& stop);
  std::optional<AttitudePrior> await_attitude(TimestampNs stamp_ns, const std::stop_token& stop);

  OpenedFrames opened_;
  FrameProcessor processor_;
  app::ProgressReporter progress_;
  std::mutex mutex_;  ///< guards track_
  std::condition_variable_any changed_;
  AttitudeTrack track_;
  AttitudeEstimate attitude_;
  /// The newest live frame that is to be searched for vanishing points.
  struct Search {
    Frame frame;
    std::optional<AttitudePrior> attitude;
  };
  std::mutex search_mutex_;
  std::condition_variable_any search_changed_;
  std::optional<Search> search_;
  std::jthread thread_, search_thread_;
  // Last, so that no attitude comes before everything above is there.
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::Imu>> attitude_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Step>> step_subscription_;
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Progress>> pdr_progress_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::vision
