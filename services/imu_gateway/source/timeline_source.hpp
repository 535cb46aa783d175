#pragma once
// Readings that are known beforehand: a recording's or the simulator's.
#include <Eigen/Core>
#include <vector>

#include "imu_gateway/source/sample_source.hpp"

namespace vpdr::imu_gateway {

/// Plays `readings` (stamp order, sensor axes) turned to body axes.
class TimelineSource : public SampleSource {
 public:
  TimelineSource(std::vector<Reading> readings, const Eigen::Matrix3d& body_from_sensor);

  State next(Reading& out) override;
  [[nodiscard]] SourceHealth health() const override { return {}; }

 private:
  std::vector<Reading> readings_;
  Eigen::Matrix3d body_from_sensor_;
  std::size_t position_ = 0;
};

}  // namespace vpdr::imu_gateway
