#include "app/consumers.hpp"

#include <utility>

namespace vpdr::app {

std::vector<std::string_view> readers_of(std::string_view topic) {
  static const std::vector<std::pair<std::string_view, std::vector<std::string_view>>> kReaders{
      {"imu/data_raw", {"pdr", "recorder"}},
      {"imu/mag", {"pdr", "recorder"}},
      {"imu/data", {"vision", "recorder"}},
      {"pdr/step", {"vision", "fusion", "recorder"}},
      {"pdr/heading", {"fusion", "recorder"}},
      {"pdr/odometry", {"fusion", "recorder"}},
      {"vision/heading", {"fusion", "recorder"}},
      {"vision/heading_rate", {"fusion", "recorder"}},
      {"playback/progress", {"imu_gateway", "vision", "fusion", "recorder"}},
  };
  for (const auto& [name, readers] : kReaders) {
    if (name == topic) return readers;
  }
  return {"recorder"};
}

bool is_service(std::string_view name) {
  return name == "imu_gateway" || name == "pdr" || name == "vision" || name == "fusion" ||
         name == "recorder";
}

}  // namespace vpdr::app
