#include "recorder/app/qos_profile.hpp"

namespace vpdr::recorder {
namespace {

// Values of rmw_qos_*_policy_t.
constexpr const char* kHistoryUnknown = "3";  // not told in discovery
constexpr const char* kReliable = "1";
constexpr const char* kBestEffort = "2";
constexpr const char* kTransientLocal = "1";
constexpr const char* kVolatile = "2";
constexpr const char* kLivelinessAutomatic = "1";
constexpr const char* kUnlimited = "\n    sec: 9223372036\n    nsec: 854775807\n";

}  // namespace

std::string offered_qos_profiles(const dds::WriterInfo& writer) {
  std::string yaml = "- history: ";
  yaml += kHistoryUnknown;
  yaml += "\n  depth: 0\n  reliability: ";
  yaml += writer.reliable ? kReliable : kBestEffort;
  yaml += "\n  durability: ";
  yaml += writer.transient_local ? kTransientLocal : kVolatile;
  yaml += std::string("\n  deadline:") + kUnlimited;
  yaml += std::string("  lifespan:") + kUnlimited;
  yaml += std::string("  liveliness: ") + kLivelinessAutomatic;
  yaml += std::string("\n  liveliness_lease_duration:") + kUnlimited;
  yaml += "  avoid_ros_namespace_conventions: false";
  return yaml;
}

}  // namespace vpdr::recorder
