#include "imu_gateway/source/timeline_source.hpp"

#include <utility>

namespace vpdr::imu_gateway {

TimelineSource::TimelineSource(std::vector<Reading> readings,
                               const Eigen::Matrix3d& body_from_sensor)
    : readings_(std::move(readings)), body_from_sensor_(body_from_sensor) {}

SampleSource::State TimelineSource::next(Reading& out) {
  if (position_ == readings_.size()) return State::kEnded;
  out = readings_[position_++];
  if (auto* imu = std::get_if<ImuSample>(&out)) {
    imu->specific_force_mps2 = body_from_sensor_ * imu->specific_force_mps2;
    imu->angular_velocity_radps = body_from_sensor_ * imu->angular_velocity_radps;
  } else if (auto* mag = std::get_if<MagSample>(&out)) {
    mag->field_ut = body_from_sensor_ * mag->field_ut;
  }
  return State::kReading;
}

}  // namespace vpdr::imu_gateway
