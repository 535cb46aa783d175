#include "dataset/about.hpp"

#include "core/rotation.hpp"
#include "dataset/yaml_fields.hpp"

namespace vpdr::dataset {
namespace {

std::optional<Eigen::Vector3d> axis_of(std::string_view name) {
  double sign = 1.0;
  if (name.size() == 2 && (name.front() == '+' || name.front() == '-')) {
    sign = name.front() == '-' ? -1.0 : 1.0;
    name.remove_prefix(1);
  }
  if (name.size() != 1 || name.front() < 'x' || name.front() > 'z') return std::nullopt;
  return sign * Eigen::Vector3d::Unit(name.front() - 'x');
}

Eigen::Matrix3d read_mount(const YAML::Node& root, const std::string& carry,
                           const std::filesystem::path& file) {
  const YAML::Node mount = root["mount"];
  if (!mount || mount.IsNull()) {
    const bool flat_phone = carry.starts_with("hand, flat");
    return flat_phone ? *mount_from_axes("+y", "+z") : Eigen::Matrix3d::Identity();
  }
  if (!mount.IsMap()) {
    throw yaml_fault(file, mount.Mark(), "mount", "must be like {forward: \"+y\", up: \"+z\"}");
  }
  const auto forward = optional_field<std::string>(mount, "forward", file, "an axis");
  const auto up = optional_field<std::string>(mount, "up", file, "an axis");
  const auto axes = mount_from_axes(forward.value_or(""), up.value_or(""));
  if (!axes) {
    throw yaml_fault(file, mount.Mark(), "mount",
                     "forward and up must be two different ones of +x -x +y -y +z -z");
  }
  return *axes;
}

/// Pairs of seconds on a clock that is `ahead_s` ahead of the recording's.
std::vector<Interval> read_intervals(const YAML::Node& root, const char* key, double ahead_s,
                                     const std::filesystem::path& file) {
  std::vector<Interval> intervals;
  const auto pairs = optional_field<std::vector<std::vector<double>>>(
      root, key, file, "a list of [begin, end] in seconds");
  for (const auto& pair : pairs.value_or(std::vector<std::vector<double>>{})) {
    if (pair.size() != 2 || !(pair[0] <= pair[1])) {
      throw yaml_fault(file, root[key].Mark(), key, "must be a list of [begin, end] in seconds");
    }
    intervals.push_back({to_ns(pair[0] - ahead_s), to_ns(pair[1] - ahead_s)});
  }
  return intervals;
}

std::optional<double> read_height_m(const YAML::Node& root, const std::filesystem::path& file) {
  const auto cm = optional_number(root, "height_cm", file);
  const auto height_m = cm ? std::optional(*cm / 100.0) : optional_number(root, "height_m", file);
  if (height_m && !(*height_m > 0.3 && *height_m < 2.8)) {
    throw yaml_fault(file, root[cm ? "height_cm" : "height_m"].Mark(), "height",
                     "must be a person's, 0.3 m to 2.8 m");
  }
  return height_m;
}

std::optional<double> read_true_steps(const YAML::Node& root, const std::filesystem::path& file) {
  const auto steps = optional_number(root, "true_steps", file);
  if (steps && *steps < 0.0) {
    throw yaml_fault(file, root["true_steps"].Mark(), "true_steps", "must be 0 or more");
  }
  return steps;
}

}  // namespace

std::optional<Eigen::Matrix3d> mount_from_axes(std::string_view forward, std::string_view up) {
  const auto x = axis_of(forward);
  const auto z = axis_of(up);
  if (!x || !z || x->dot(*z) != 0.0) return std::nullopt;
  Eigen::Matrix3d body_from_sensor;
  body_from_sensor.row(0) = x->transpose();
  body_from_sensor.row(1) = z->cross(*x).transpose();
  body_from_sensor.row(2) = z->transpose();
  return body_from_sensor;
}

About read_about(const std::filesystem::path& file) {
  const YAML::Node root = load_yaml(file);
  About about;
  if (root.IsNull()) return about;
  if (!root.IsMap()) throw yaml_fault(file, root.Mark(), "document", "must be 'key: value' lines");
  about.dataset = optional_field<std::string>(root, "dataset", file, "text").value_or("");
  about.trial = optional_field<std::string>(root, "trial", file, "text").value_or("");
  about.carry = optional_field<std::string>(root, "carry", file, "text").value_or("");
  about.mount = read_mount(root, about.carry, file);
  about.declination_rad = to_radians(optional_number(root, "declination_deg", file).value_or(0.0));
  about.rate_hz = optional_number(root, "rate_hz", file);
  about.true_steps = read_true_steps(root, file);
  about.height_m = read_height_m(root, file);
  about.magnetic_disturbance =
      optional_field<bool>(root, "magnetic_disturbance", file, "true or false");
  const double ahead_s = optional_number(root, "mocap_minus_phone_s", file).value_or(0.0);
  about.reference_faults = read_intervals(root, "reference_faults_mocap_s", ahead_s, file);
  const auto own_clock = read_intervals(root, "reference_faults_s", 0.0, file);
  about.reference_faults.insert(about.reference_faults.end(), own_clock.begin(), own_clock.end());
  if (const auto camera = optional_field<std::string>(root, "camera", file, "a path")) {
    about.camera = file.parent_path() / *camera;
  }
  return about;
}

}  // namespace vpdr::dataset
