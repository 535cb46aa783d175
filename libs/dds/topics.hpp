#pragma once
// Every topic of a walker: name, type, quality of service. Topic X is the DDS topic
// "rt/<walker>/X", which ROS 2 sees as /<walker>/X.
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sensor_msgs::msg {
class Imu;
class MagneticField;
class FluidPressure;
class Temperature;
class CompressedImage;
}  // namespace sensor_msgs::msg
namespace geometry_msgs::msg {
class PoseWithCovarianceStamped;
}
namespace nav_msgs::msg {
class Odometry;
class Path;
}  // namespace nav_msgs::msg
namespace diagnostic_msgs::msg {
class DiagnosticArray;
}
namespace vpdr_msgs::msg {
class Step;
class Heading;
class CorridorHeading;
class HeadingRate;
class Motion;
class Loop;
class Calibration;
class FusionState;
class Progress;
}  // namespace vpdr_msgs::msg

namespace vpdr::dds {

/// Quality of service of both ends of a topic.
struct Qos {
  bool reliable = true;
  bool transient_local = false;  ///< a late reader gets the last `depth` samples
  int depth = 100;               ///< samples the writer keeps for readers that lag
  double deadline_s = 0.0;       ///< a longer silence is counted; 0: none
  /// s, how often a writer asks reliable readers what they lack: a lost sample comes once or twice
  /// so much later. Each question wakes both ends.
  double heartbeat_s = 0.02;
  bool large = false;  ///< sent by a thread of its own, so that publish() is quick
};

/// A topic without its C++ type.
struct TopicInfo {
  std::string_view name;  ///< after "rt/<walker>/"
  std::string_view type;  ///< "sensor_msgs/msg/Imu"
  std::string_view from;  ///< the service that publishes it; "*": every one
  Qos qos;
};

/// A topic of messages T.
template <class T>
struct Topic {
  TopicInfo info;
};

namespace topics {

// Two seconds at the fastest board's 1000 samples/s. Deadlines are five periods of the slowest
// source: 50 samples/s inertial, 10 magnetic, 1 barometric and of temperature. What is slower may
// come later where a datagram is lost; a field is of use to pdr for 0.1 s.
inline constexpr Qos kImuQos{.depth = 2000, .deadline_s = 0.1};
inline constexpr Qos kMagQos{.depth = 400, .deadline_s = 0.5, .heartbeat_s = 0.04};
inline constexpr Qos kPressureQos{.depth = 400, .deadline_s = 5.0, .heartbeat_s = 0.1};
inline constexpr Qos kTemperatureQos{.depth = 20, .deadline_s = 5.0, .heartbeat_s = 0.1};
inline constexpr Qos kEventQos{.depth = 100};
inline constexpr Qos kOdometryQos{.depth = 2000};
inline constexpr Qos kLatchedQos{.transient_local = true, .depth = 1};
// A playback that hears of a service late hears how far it is all the same: it would wait for ever
// for news of samples that it has published before.
inline constexpr Qos kProgressQos{.transient_local = true, .depth = 100};

inline constexpr Topic<sensor_msgs::msg::Imu> kImuRaw{
    {"imu/data_raw", "sensor_msgs/msg/Imu", "imu_gateway", kImuQos}};
inline constexpr Topic<sensor_msgs::msg::MagneticField> kMag{
    {"imu/mag", "sensor_msgs/msg/MagneticField", "imu_gateway", kMagQos}};
inline constexpr Topic<sensor_msgs::msg::FluidPressure> kPressure{
    {"imu/pressure", "sensor_msgs/msg/FluidPressure", "imu_gateway", kPressureQos}};
inline constexpr Topic<sensor_msgs::msg::Temperature> kTemperature{
    {"imu/temperature", "sensor_msgs/msg/Temperature", "imu_gateway", kTemperatureQos}};
inline constexpr Topic<sensor_msgs::msg::Imu> kAttitude{
    {"imu/data", "sensor_msgs/msg/Imu", "pdr", kImuQos}};
inline constexpr Topic<vpdr_msgs::msg::Step> kStep{
    {"pdr/step", "vpdr_msgs/msg/Step", "pdr", kEventQos}};
inline constexpr Topic<vpdr_msgs::msg::Heading> kHeading{
    {"pdr/heading", "vpdr_msgs/msg/Heading", "pdr", kEventQos}};
inline constexpr Topic<nav_msgs::msg::Odometry> kPdrOdometry{
    {"pdr/odometry", "nav_msgs/msg/Odometry", "pdr", kOdometryQos}};
inline constexpr Topic<vpdr_msgs::msg::CorridorHeading> kCorridorHeading{
    {"vision/heading", "vpdr_msgs/msg/CorridorHeading", "vision", kEventQos}};
inline constexpr Topic<vpdr_msgs::msg::HeadingRate> kHeadingRate{
    {"vision/heading_rate", "vpdr_msgs/msg/HeadingRate", "vision", kEventQos}};
inline constexpr Topic<vpdr_msgs::msg::Motion> kMotion{
    {"vision/motion", "vpdr_msgs/msg/Motion", "vision", kEventQos}};
inline constexpr Topic<vpdr_msgs::msg::Loop> kLoop{
    {"vision/loop", "vpdr_msgs/msg/Loop", "vision", kEventQos}};
inline constexpr Topic<nav_msgs::msg::Odometry> kVisionOdometry{
    {"vision/odometry", "nav_msgs/msg/Odometry", "vision", kOdometryQos}};
inline constexpr Topic<sensor_msgs::msg::CompressedImage> kImage{
    {"camera/image/compressed",
     "sensor_msgs/msg/CompressedImage",
     "vision",
     {.reliable = false, .depth = 4, .large = true}}};
inline constexpr Topic<geometry_msgs::msg::PoseWithCovarianceStamped> kFusedPose{
    {"fusion/pose", "geometry_msgs/msg/PoseWithCovarianceStamped", "fusion", kOdometryQos}};
inline constexpr Topic<nav_msgs::msg::Odometry> kFusedOdometry{
    {"fusion/odometry", "nav_msgs/msg/Odometry", "fusion", kOdometryQos}};
inline constexpr Topic<vpdr_msgs::msg::FusionState> kFusionState{
    {"fusion/state", "vpdr_msgs/msg/FusionState", "fusion", kOdometryQos}};
inline constexpr Topic<nav_msgs::msg::Path> kPath{
    {"fusion/path",
     "nav_msgs/msg/Path",
     "fusion",
     {.transient_local = true, .depth = 1, .large = true}}};
inline constexpr Topic<vpdr_msgs::msg::Calibration> kCalibration{
    {"calibration", "vpdr_msgs/msg/Calibration", "imu_gateway", kLatchedQos}};
inline constexpr Topic<vpdr_msgs::msg::Progress> kProgress{
    {"playback/progress", "vpdr_msgs/msg/Progress", "*", kProgressQos}};
inline constexpr Topic<diagnostic_msgs::msg::DiagnosticArray> kDiagnostics{
    {"diagnostics", "diagnostic_msgs/msg/DiagnosticArray", "*", kEventQos}};

/// All of the above.
std::span<const TopicInfo> all();

/// The topic of that name, without "rt/<walker>/".
std::optional<TopicInfo> find(std::string_view name);

}  // namespace topics

/// "rt/<walker>/<name>".
std::string topic_path(std::string_view walker, std::string_view name);

/// A topic of some walker, taken apart.
struct WalkerTopic {
  std::string walker;
  std::string name;
};

/// The inverse of topic_path. None where the path is not "rt/<walker>/<name>".
std::optional<WalkerTopic> parse_topic_path(std::string_view path);

/// Whether `name` may be a walker's: letters, digits and "_", a letter first (ROS 2's rule for
/// namespaces).
bool is_walker_name(std::string_view name);

}  // namespace vpdr::dds
