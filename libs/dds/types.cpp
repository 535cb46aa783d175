#include "dds/types.hpp"

#include <fastcdr/Cdr.h>

#include "builtin_interfaces.h"
#include "diagnostic_msgs.h"
#include "geometry_msgs.h"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "std_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::dds {
namespace {

constexpr std::string_view kWireInfix = "::msg::dds_::";
constexpr std::string_view kRosInfix = "/msg/";

}  // namespace

template <class T>
struct NameOf;

template <class T>
const MessageType& message_type() {
  static constexpr MessageType kType{
      NameOf<T>::kValue,
      [](const void* s) { return T::getCdrSerializedSize(*static_cast<const T*>(s)); },
      [](const void* s, eprosima::fastcdr::Cdr& cdr) { static_cast<const T*>(s)->serialize(cdr); },
      [](void* s, eprosima::fastcdr::Cdr& cdr) { static_cast<T*>(s)->deserialize(cdr); }};
  return kType;
}

#define VPDR_MESSAGE(package, type)                                    \
  template <>                                                          \
  struct NameOf<::package::msg::type> {                                \
    static constexpr std::string_view kValue = #package "/msg/" #type; \
  };                                                                   \
  template const MessageType& message_type<::package::msg::type>();

VPDR_MESSAGE(builtin_interfaces, Time)
VPDR_MESSAGE(builtin_interfaces, Duration)
VPDR_MESSAGE(std_msgs, Header)
VPDR_MESSAGE(geometry_msgs, Point)
VPDR_MESSAGE(geometry_msgs, Vector3)
VPDR_MESSAGE(geometry_msgs, Quaternion)
VPDR_MESSAGE(geometry_msgs, Pose)
VPDR_MESSAGE(geometry_msgs, PoseWithCovariance)
VPDR_MESSAGE(geometry_msgs, PoseStamped)
VPDR_MESSAGE(geometry_msgs, PoseWithCovarianceStamped)
VPDR_MESSAGE(geometry_msgs, Twist)
VPDR_MESSAGE(geometry_msgs, TwistWithCovariance)
VPDR_MESSAGE(sensor_msgs, Imu)
VPDR_MESSAGE(sensor_msgs, MagneticField)
VPDR_MESSAGE(sensor_msgs, FluidPressure)
VPDR_MESSAGE(sensor_msgs, Temperature)
VPDR_MESSAGE(sensor_msgs, CompressedImage)
VPDR_MESSAGE(nav_msgs, Odometry)
VPDR_MESSAGE(nav_msgs, Path)
VPDR_MESSAGE(diagnostic_msgs, KeyValue)
VPDR_MESSAGE(diagnostic_msgs, DiagnosticStatus)
VPDR_MESSAGE(diagnostic_msgs, DiagnosticArray)
VPDR_MESSAGE(vpdr_msgs, Step)
VPDR_MESSAGE(vpdr_msgs, Heading)
VPDR_MESSAGE(vpdr_msgs, CorridorHeading)
VPDR_MESSAGE(vpdr_msgs, HeadingRate)
VPDR_MESSAGE(vpdr_msgs, Progress)
VPDR_MESSAGE(vpdr_msgs, Motion)
VPDR_MESSAGE(vpdr_msgs, Loop)
VPDR_MESSAGE(vpdr_msgs, Calibration)
VPDR_MESSAGE(vpdr_msgs, FusionState)

#undef VPDR_MESSAGE

std::string wire_type_name(std::string_view ros_name) {
  const auto at = ros_name.find(kRosInfix);
  if (at == std::string_view::npos) return std::string(ros_name);
  std::string wire(ros_name.substr(0, at));
  wire.append(kWireInfix).append(ros_name.substr(at + kRosInfix.size())).append("_");
  return wire;
}

std::string ros_type_name(std::string_view wire_name) {
  const auto at = wire_name.find(kWireInfix);
  if (at == std::string_view::npos || wire_name.back() != '_') return std::string(wire_name);
  std::string ros(wire_name.substr(0, at));
  ros.append(kRosInfix).append(wire_name.substr(at + kWireInfix.size()));
  ros.pop_back();
  return ros;
}

}  // namespace vpdr::dds
