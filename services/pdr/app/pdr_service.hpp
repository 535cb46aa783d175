#pragma once
// pdr on the network: inertial, magnetometer and barometer samples in; attitude, steps, heading,
// odometry out.
#include <memory>
#include <mutex>

#include "app/progress.hpp"
#include "app/service.hpp"
#include "nav_msgs.h"
#include "pdr/core/pdr.hpp"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::pdr {

/// Works in the subscriptions' thread, sample by sample, so that an acknowledged sample is a
/// processed one.
class PdrService : public app::Service {
 public:
  PdrService(const PdrConfig& config, app::ServiceContext& context);

  void report(app::Health& health) override;
  [[nodiscard]] std::vector<std::string> upstream() const override { return {"imu_gateway"}; }
  void close() override;

 private:
  void take(const sensor_msgs::msg::Imu& message);
  void take(const vpdr_msgs::msg::Calibration& message);
  void take(const sensor_msgs::msg::MagneticField& message);
  void take(const sensor_msgs::msg::FluidPressure& message);
  void report_height(app::Health& health) const;
  void publish();

  std::mutex mutex_;  ///< guards pdr_ between the listeners and report()
  Pdr pdr_;
  PdrOutput output_;
  ImuSample imu_;
  MagSample mag_;
  PressureSample pressure_;
  sensor_msgs::msg::Imu attitude_message_;
  vpdr_msgs::msg::Step step_message_;
  vpdr_msgs::msg::Heading heading_message_;
  nav_msgs::msg::Odometry odometry_message_;

  std::unique_ptr<dds::Publisher<sensor_msgs::msg::Imu>> attitude_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::Step>> step_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::Heading>> heading_publisher_;
  std::unique_ptr<dds::Publisher<nav_msgs::msg::Odometry>> odometry_publisher_;
  app::ProgressReporter progress_;
  // Last, so that no sample comes before everything above is there.
  std::unique_ptr<dds::Subscription<vpdr_msgs::msg::Calibration>> calibration_subscription_;
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::MagneticField>> mag_subscription_;
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::FluidPressure>> pressure_subscription_;
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::Imu>> imu_subscription_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::pdr
