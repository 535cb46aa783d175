#include "dds/topics.hpp"

#include <algorithm>
#include <array>

namespace vpdr::dds {
namespace {

constexpr std::string_view kPrefix = "rt/";
/// A topic's path, of at most 255 characters in DDS, has room for it.
constexpr std::size_t kLongestWalkerName = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::span<const TopicInfo> topics::all() {
  static constexpr std::array kAll{kImuRaw.info,         kMag.info,         kPressure.info,
                                   kTemperature.info,    kAttitude.info,    kStep.info,
                                   kHeading.info,        kPdrOdometry.info, kCorridorHeading.info,
                                   kHeadingRate.info,    kMotion.info,      kLoop.info,
                                   kVisionOdometry.info, kImage.info,       kFusedPose.info,
                                   kFusedOdometry.info,  kFusionState.info, kPath.info,
                                   kCalibration.info,    kProgress.info,    kDiagnostics.info};
  return kAll;
}

std::optional<TopicInfo> topics::find(std::string_view name) {
  const auto known = all();
  const auto at = std::find_if(known.begin(), known.end(),
                               [&](const TopicInfo& topic) { return topic.name == name; });
  if (at == known.end()) return std::nullopt;
  return *at;
}

std::string topic_path(std::string_view walker, std::string_view name) {
  std::string path(kPrefix);
  path.append(walker).append("/").append(name);
  return path;
}

std::optional<WalkerTopic> parse_topic_path(std::string_view path) {
  if (!path.starts_with(kPrefix)) return std::nullopt;
  path.remove_prefix(kPrefix.size());
  const auto slash = path.find('/');
  if (slash == std::string_view::npos || slash == 0 || slash + 1 == path.size()) {
    return std::nullopt;
  }
  return WalkerTopic{std::string(path.substr(0, slash)), std::string(path.substr(slash + 1))};
}

bool is_walker_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestWalkerName && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

}  // namespace vpdr::dds
