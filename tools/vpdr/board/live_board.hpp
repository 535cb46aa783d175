#pragma once
// The board behind a running imu_gateway, as its sensors read: what the gateway has corrected and
// turned is undone by the calibration it publishes.
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "calibration/board_calibration.hpp"
#include "core/sensor_streams.hpp"
#include "dds/subscription.hpp"

namespace vpdr::tool {

class LiveBoard {
 public:
  explicit LiveBoard(dds::Participant& participant);

  /// Waits until a sample comes after this call, or the time is over: whether one came.
  bool wait_for_sample(std::chrono::milliseconds timeout);
  /// All samples so far. Thread-safe.
  [[nodiscard]] SensorStreams streams() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  calibration::BoardCalibration applied_;  ///< by the gateway
  bool is_known_ = false;                  ///< samples before the calibration are not used
  SensorStreams streams_;
  dds::Subscription<vpdr_msgs::msg::Calibration> calibration_;
  dds::Subscription<sensor_msgs::msg::Imu> imu_;
  dds::Subscription<sensor_msgs::msg::MagneticField> mag_;
  dds::Subscription<sensor_msgs::msg::Temperature> temperature_;
};

}  // namespace vpdr::tool
