#pragma once
// imu_gateway: samples in from a source, calibrated, checked, and out on the topics.
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/service.hpp"
#include "imu_gateway/app/make_source.hpp"
#include "imu_gateway/app/playback.hpp"
#include "imu_gateway/app/stream_report.hpp"
#include "imu_gateway/core/sample_correction.hpp"
#include "imu_gateway/core/startup_checks.hpp"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::imu_gateway {

/// One thread reads the source and publishes; reports come from the main thread.
class GatewayService : public app::Service {
 public:
  GatewayService(const GatewaySettings& settings, app::ServiceContext& context);
  ~GatewayService() override;

  void start() override;
  void report(app::Health& health) override;
  bool at_end() override { return ended_; }
  void close() override;

 private:
  void run(const std::stop_token& stop);
  void publish_calibration();
  void publish(Reading& reading);
  template <class Sample, class Message>
  void publish_checked(const Sample& sample, StreamReport& stream, Message& message,
                       dds::Publisher<Message>* publisher);
  void publish_temperature(TimestampNs stamp_ns);
  void finish(const std::stop_token& stop);
  /// Waits, for some seconds at most, until all that was published has been taken.
  void hand_over();
  void report_findings(app::Health& health);

  OpenedSource opened_;
  calibration::BoardCalibration board_;
  std::optional<SampleCorrection> correction_;  ///< nullopt: the board is not calibrated
  /// Latched: whoever comes late gets it, so nobody is waited for.
  dds::Publisher<vpdr_msgs::msg::Calibration> calibration_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::Imu>> imu_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::MagneticField>> mag_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::FluidPressure>> pressure_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::Temperature>> temperature_publisher_;
  Playback playback_;
  sensor_msgs::msg::Imu imu_message_;
  sensor_msgs::msg::MagneticField mag_message_;
  sensor_msgs::msg::FluidPressure pressure_message_;
  sensor_msgs::msg::Temperature temperature_message_;
  TimestampNs last_temperature_ns_ = 0;

  std::mutex mutex_;  ///< guards the reports and the health copy
  StreamReport imu_{"imu"};
  StreamReport mag_{"mag"};
  StreamReport pressure_{"pressure"};
  SourceHealth source_health_;
  StartupChecks checks_;
  std::size_t findings_logged_ = 0;
  std::atomic<bool> ended_{false};
  std::jthread thread_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::imu_gateway
