#pragma once
// Typed reads of YAML nodes whose faults name the place. Included by this library's .cpp files
// only.
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dataset/text_file.hpp"

namespace vpdr::dataset {

inline FileFault yaml_fault(const std::filesystem::path& file, const YAML::Mark& mark,
                            const std::string& key, const std::string& what) {
  const auto from_one = [](int at) { return static_cast<std::uint64_t>(at < 0 ? 0 : at + 1); };
  return fault_at(file, from_one(mark.line), from_one(mark.column), key + ": " + what,
                  "correct the value or remove the key");
}

/// The document of a file; throws FileFault with the place of a syntax error.
inline YAML::Node load_yaml(const std::filesystem::path& file) {
  std::string text = read_text_file(file).text;
  // OpenCV's "%YAML:1.0" directive is not YAML.
  if (text.starts_with("%YAML:")) text.erase(0, text.find('\n'));
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw yaml_fault(file, error.mark, "YAML", error.msg);
  }
}

/// node[key] as T; nullopt where absent or null.
template <class T>
std::optional<T> optional_field(const YAML::Node& node, const char* key,
                                const std::filesystem::path& file, const char* kind) {
  const YAML::Node value = node[key];
  if (!value || value.IsNull()) return std::nullopt;
  try {
    return value.as<T>();
  } catch (const YAML::Exception&) {
    throw yaml_fault(file, value.Mark(), key, std::string("must be ") + kind);
  }
}

/// node[key] as a finite number; nullopt where absent or null.
inline std::optional<double> optional_number(const YAML::Node& node, const char* key,
                                             const std::filesystem::path& file) {
  const auto value = optional_field<double>(node, key, file, "a number");
  if (value && !std::isfinite(*value)) {
    throw yaml_fault(file, node[key].Mark(), key, "must be finite");
  }
  return value;
}

/// node[key] as exactly `count` numbers.
inline std::vector<double> number_list(const YAML::Node& node, const char* key, std::size_t count,
                                       const std::filesystem::path& file) {
  const auto values = optional_field<std::vector<double>>(node, key, file, "a list of numbers");
  if (!values) throw yaml_fault(file, node.Mark(), key, "is missing");
  if (values->size() != count) {
    throw yaml_fault(
        file, node[key].Mark(), key,
        "must have " + std::to_string(count) + " numbers, has " + std::to_string(values->size()));
  }
  return *values;
}

}  // namespace vpdr::dataset
