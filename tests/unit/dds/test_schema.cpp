// The .msg texts, the .idl files and the generated code say the same.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "dds/schema.hpp"
#include "dds/types.hpp"

namespace vpdr::dds {
namespace {

namespace fs = std::filesystem;
using Fields = std::vector<std::string>;            // "float64[9] name", in their order
using Definitions = std::map<std::string, Fields>;  // by "package/msg/Type"

const fs::path kIdl = fs::path(VPDR_SOURCE_DIR) / "idl";

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The .msg name of an IDL type.
std::string msg_type(const std::string& idl_type) {
  static const std::map<std::string, std::string> kBasic{
      {"long", "int32"},  {"unsigned long", "uint32"}, {"double", "float64"},
      {"octet", "uint8"}, {"boolean", "bool"},         {"string", "string"}};
  if (const auto at = kBasic.find(idl_type); at != kBasic.end()) return at->second;
  return std::regex_replace(idl_type, std::regex("::msg::"), "/");
}

Definitions read_idl() {
  const std::regex comment("//[^\n]*");
  const std::regex structure(R"(struct\s+(\w+)\s*\{([^}]*)\})");
  const std::regex field(R"(([^;\[\]]+?)\s+(\w+)\s*(\[\d+\])?\s*;)");
  const std::regex sequence(R"(sequence<([^>]+)>)");
  Definitions found;
  for (const auto& entry : fs::directory_iterator(kIdl)) {
    if (entry.path().extension() != ".idl") continue;
    const std::string text = std::regex_replace(read(entry.path()), comment, "");
    for (std::sregex_iterator s(text.begin(), text.end(), structure), end; s != end; ++s) {
      const std::string body = (*s)[2];
      Fields fields;
      for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) {
        const std::string type = std::regex_replace(std::string((*f)[1]), std::regex("^\\s+"), "");
        std::smatch item;
        const std::string full = std::regex_match(type, item, sequence)
                                     ? msg_type(item[1]) + "[]"
                                     : msg_type(type) + std::string((*f)[3]);
        fields.push_back(full + " " + std::string((*f)[2]));
      }
      found[entry.path().stem().string() + "/msg/" + std::string((*s)[1])] = fields;
    }
  }
  return found;
}

/// Fields of a .msg text; types of its own package get the package's name, `byte` is uint8.
Fields msg_fields(const std::string& text, const std::string& package) {
  const std::regex field(R"(([\w/]+)(\[\d*\])?\s+(\w+))");
  std::istringstream lines(text);
  Fields fields;
  for (std::string line; std::getline(lines, line);) {
    std::smatch part;
    if (line.starts_with("#") || !std::regex_match(line, part, field)) continue;
    std::string type = part[1];
    if (type == "byte") type = "uint8";
    if (std::isupper(static_cast<unsigned char>(type[0])) != 0) type = package + "/" + type;
    fields.push_back(type + std::string(part[2]) + " " + std::string(part[3]));
  }
  return fields;
}

Definitions read_msg() {
  Definitions found;
  for (const auto& entry : fs::recursive_directory_iterator(kIdl / "msg")) {
    if (entry.path().extension() != ".msg") continue;
    const std::string package = entry.path().parent_path().filename().string();
    found[package + "/msg/" + entry.path().stem().string()] =
        msg_fields(read(entry.path()), package);
  }
  return found;
}

TEST(Schema, MsgAndIdlHaveTheSameTypesAndFields) {
  const Definitions idl = read_idl();
  const Definitions msg = read_msg();
  EXPECT_EQ(idl.size(), 31U);
  EXPECT_EQ(idl, msg);
}

TEST(Schema, NamesOnTheWireAreThoseOfTheGeneratedCode) {
  const std::regex name("setName\\(\"([^\"]+)\"\\)");
  std::set<std::string> generated;
  for (const auto& entry : fs::directory_iterator(VPDR_GENERATED_IDL_DIR)) {
    if (!entry.path().string().ends_with("PubSubTypes.cxx")) continue;
    const std::string text = read(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at) {
      generated.insert((*at)[1]);
    }
  }
  std::set<std::string> ours;
  for (const auto& [type, fields] : read_idl()) ours.insert(wire_type_name(type));
  EXPECT_EQ(ours, generated);
}

TEST(Schema, HasTheTypesItIsMadeOfOnceEachUnderTheirNames) {
  const std::string rule(80, '=');
  EXPECT_EQ(ros2msg_schema("std_msgs/msg/Header"),
            read(kIdl / "msg/std_msgs/Header.msg") + rule + "\nMSG: builtin_interfaces/Time\n" +
                read(kIdl / "msg/builtin_interfaces/Time.msg"));
  const std::string odometry = ros2msg_schema("nav_msgs/msg/Odometry");
  std::vector<std::string> parts;
  const std::regex part("MSG: (\\S+)\n");
  for (std::sregex_iterator at(odometry.begin(), odometry.end(), part), end; at != end; ++at) {
    parts.push_back((*at)[1]);
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"std_msgs/Header", "geometry_msgs/PoseWithCovariance",
                                             "geometry_msgs/TwistWithCovariance",
                                             "builtin_interfaces/Time", "geometry_msgs/Pose",
                                             "geometry_msgs/Twist", "geometry_msgs/Point",
                                             "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}));
  EXPECT_TRUE(odometry.starts_with(read(kIdl / "msg/nav_msgs/Odometry.msg") + rule));
}

TEST(Schema, IsEmptyForUnknownTypes) {
  EXPECT_TRUE(ros2msg_schema("sensor_msgs/msg/Joy").empty());
  EXPECT_TRUE(ros2msg_schema("sensor_msgs/Imu").empty());
  EXPECT_TRUE(ros2msg_schema("").empty());
}

TEST(Schema, HashIsSixteenHexadecimalDigits) {
  EXPECT_TRUE(std::regex_match(std::string(idl_hash()), std::regex("[0-9a-f]{16}")));
}

}  // namespace
}  // namespace vpdr::dds
