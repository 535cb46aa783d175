#include "vpdr/board/live_board.hpp"

#include "dds/convert.hpp"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::tool {

LiveBoard::LiveBoard(dds::Participant& participant)
    : calibration_(participant, dds::topics::kCalibration,
                   [this](const vpdr_msgs::msg::Calibration& message, const dds::SampleInfo&) {
                     const std::lock_guard lock(mutex_);
                     dds::from_msg(message, applied_);
                     is_known_ = true;
                   }),
      imu_(participant, dds::topics::kImuRaw,
           [this](const sensor_msgs::msg::Imu& message, const dds::SampleInfo&) {
             ImuSample sample;
             dds::from_msg(message, sample);
             const std::lock_guard lock(mutex_);
             if (!is_known_) return;
             const Eigen::Matrix3d board_from_body = applied_.mount.body_from_board.transpose();
             streams_.force_mps2.push_back(
                 {sample.stamp_ns, applied_.accelerometer.correction.undo(
                                       board_from_body * sample.specific_force_mps2)});
             if (sample.has_angular_velocity) {
               Eigen::Vector3d read = applied_.gyroscope.correction.undo(
                   board_from_body * sample.angular_velocity_radps);
               const auto& celsius = streams_.temperature_c;
               if (!celsius.empty()) read += applied_.gyroscope.bias_change(celsius.back().value);
               streams_.rate_radps.push_back({sample.stamp_ns, read});
             }
             changed_.notify_all();
           }),
      mag_(participant, dds::topics::kMag,
           [this](const sensor_msgs::msg::MagneticField& message, const dds::SampleInfo&) {
             MagSample sample;
             dds::from_msg(message, sample);
             const std::lock_guard lock(mutex_);
             if (!is_known_) return;
             streams_.field_ut.push_back(
                 {sample.stamp_ns,
                  applied_.magnetometer.correction.undo(applied_.mount.body_from_board.transpose() *
                                                        sample.field_ut)});
           }),
      temperature_(participant, dds::topics::kTemperature,
                   [this](const sensor_msgs::msg::Temperature& message, const dds::SampleInfo&) {
                     TimedValue celsius;
                     dds::from_msg(message, celsius);
                     const std::lock_guard lock(mutex_);
                     if (is_known_) streams_.temperature_c.push_back(celsius);
                   }) {}

bool LiveBoard::wait_for_sample(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  const std::size_t before = streams_.force_mps2.size();
  return changed_.wait_for(lock, timeout, [&] { return streams_.force_mps2.size() > before; });
}

SensorStreams LiveBoard::streams() const {
  const std::lock_guard lock(mutex_);
  return streams_;
}

}  // namespace vpdr::tool
