#include "dds/schema.hpp"

#include <algorithm>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

namespace vpdr::dds {

// In the generated build/idl/idl_texts.cpp.
std::string_view idl_hash_text();
std::span<const std::pair<std::string_view, std::string_view>> msg_texts();

namespace {

constexpr std::size_t kSeparatorWidth = 80;

/// Text of "package/Type"; empty where there is none.
std::string_view text_of(const std::string& type) {
  const auto slash = type.find('/');
  if (slash == std::string::npos) return {};
  const std::string full = type.substr(0, slash) + "/msg/" + type.substr(slash + 1);
  for (const auto& [name, text] : msg_texts()) {
    if (name == full) return text;
  }
  return {};
}

/// "package/Type" of the message types that the fields of `type` have, in their order.
std::vector<std::string> field_types(const std::string& type) {
  const std::string package = type.substr(0, type.find('/'));
  std::istringstream lines{std::string(text_of(type))};
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);) {
    std::string field = line.substr(0, line.find_first_of(" ["));
    if (field.find('/') == std::string::npos) field = package + "/" + field;
    if (!text_of(field).empty()) found.push_back(std::move(field));
  }
  return found;
}

}  // namespace

std::string_view idl_hash() { return idl_hash_text(); }

std::string ros2msg_schema(std::string_view ros_type) {
  const auto infix = ros_type.find("/msg/");
  if (infix == std::string_view::npos) return {};
  const std::string root =
      std::string(ros_type.substr(0, infix)) + "/" + std::string(ros_type.substr(infix + 5));
  std::string schema(text_of(root));
  if (schema.empty()) return {};
  std::vector<std::string> types{root};
  for (std::size_t i = 0; i < types.size(); ++i) {
    for (auto& field : field_types(types[i])) {
      if (std::find(types.begin(), types.end(), field) == types.end()) types.push_back(field);
    }
    if (i == 0) continue;
    schema += std::string(kSeparatorWidth, '=') + "\nMSG: " + types[i] + "\n";
    schema += text_of(types[i]);
  }
  return schema;
}

}  // namespace vpdr::dds
