#pragma once
// From settings to the source of samples.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "dds/participant.hpp"
#include "imu_gateway/app/gateway_settings.hpp"
#include "imu_gateway/source/sample_source.hpp"

namespace vpdr::imu_gateway {

/// A source and what is known of it beforehand.
struct OpenedSource {
  std::unique_ptr<SampleSource> source;
  std::string name = "recording";  ///< prefix of its counters
  bool has_magnetometer = false;
  bool has_pressure = false;
  bool has_temperature = false;
  /// How the source turns the board's axes to the body's.
  Eigen::Matrix3d body_from_board = Eigen::Matrix3d::Identity();
  bool is_playback = false;        ///< known stamps, to be paced; false: a board, as it comes
  std::uint64_t refused_rows = 0;  ///< rows of a recording that were refused on reading
};

/// Throws ConfigurationFault where not exactly one source is chosen or an axis map is wrong,
/// FileFault for a recording and DeviceFault for a port that cannot be used.
OpenedSource open_source(const GatewaySettings& settings, dds::Participant& participant);

}  // namespace vpdr::imu_gateway
