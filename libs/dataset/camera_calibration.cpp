#include "dataset/camera_calibration.hpp"

#include <Eigen/LU>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "dataset/yaml_fields.hpp"

namespace vpdr::dataset {
namespace {

using Path = std::filesystem::path;

void set_intrinsics(CameraCalibration& camera, const std::vector<double>& f) {
  camera.fx = f[0];
  camera.fy = f[1];
  camera.cx = f[2];
  camera.cy = f[3];
}

void require_pinhole(const YAML::Node& node, const Path& file) {
  const auto model = optional_field<std::string>(node, "camera_model", file, "text");
  if (model && *model != "pinhole") {
    throw yaml_fault(file, node["camera_model"].Mark(), "camera_model",
                     "'" + *model + "' is not supported, only pinhole");
  }
}

void set_distortion(CameraCalibration& camera, const YAML::Node& node, const char* coefficients_key,
                    const YAML::Node& coefficients, const Path& file) {
  const auto model = optional_field<std::string>(node, "distortion_model", file, "text");
  const std::string name = model.value_or("none");
  if (name == "none" || name.empty()) return;
  if (name == "radtan" || name == "radial-tangential" || name == "plumb_bob" ||
      name == "rational_polynomial") {
    camera.distortion = Distortion::kRadialTangential;
  } else if (name == "equidistant" || name == "equi" || name == "fisheye") {
    camera.distortion = Distortion::kEquidistant;
  } else {
    throw yaml_fault(file, node["distortion_model"].Mark(), "distortion_model",
                     "'" + name + "' is not one of none, radtan, plumb_bob, equidistant");
  }
  try {
    camera.coefficients = coefficients.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    throw yaml_fault(file, node.Mark(), coefficients_key, "must be a list of numbers");
  }
  if (camera.coefficients.size() < 4) {
    throw yaml_fault(file, node.Mark(), coefficients_key, "must have at least four numbers");
  }
}

void set_resolution(CameraCalibration& camera, const YAML::Node& node, const Path& file) {
  const std::vector<double> size = number_list(node, "resolution", 2, file);
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
}

Eigen::Matrix4d matrix_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
}

/// EuRoC: T_BS is body from sensor.
CameraCalibration read_euroc(const YAML::Node& root, const Path& file) {
  CameraCalibration camera;
  require_pinhole(root, file);
  set_intrinsics(camera, number_list(root, "intrinsics", 4, file));
  set_distortion(camera, root, "distortion_coefficients", root["distortion_coefficients"], file);
  set_resolution(camera, root, file);
  camera.rate_hz = optional_number(root, "rate_hz", file).value_or(0.0);
  if (root["T_BS"]) {
    camera.body_from_camera = matrix_of(number_list(root["T_BS"], "data", 16, file));
    camera.has_mounting = true;
  }
  return camera;
}

/// Kalibr: T_cam_imu is camera from body, four rows of four.
CameraCalibration read_kalibr(const YAML::Node& node, const Path& file) {
  CameraCalibration camera;
  require_pinhole(node, file);
  set_intrinsics(camera, number_list(node, "intrinsics", 4, file));
  set_distortion(camera, node, "distortion_coeffs", node["distortion_coeffs"], file);
  set_resolution(camera, node, file);
  camera.timeshift_s = optional_number(node, "timeshift_cam_imu", file).value_or(0.0);
  camera.pitch_rad = optional_number(node, "pitch_rad", file);
  camera.height_m = optional_number(node, "height_m", file);
  if (camera.height_m && !(*camera.height_m > 0.0)) {
    throw yaml_fault(file, node["height_m"].Mark(), "height_m", "must be > 0");
  }
  const auto rows = optional_field<std::vector<std::vector<double>>>(node, "T_cam_imu", file,
                                                                     "four rows of four numbers");
  if (!rows) return camera;
  std::vector<double> numbers;
  for (const auto& row : *rows) numbers.insert(numbers.end(), row.begin(), row.end());
  if (rows->size() != 4 || numbers.size() != 16) {
    throw yaml_fault(file, node["T_cam_imu"].Mark(), "T_cam_imu", "must be four rows of four");
  }
  camera.body_from_camera = matrix_of(numbers).inverse();
  camera.has_mounting = true;
  return camera;
}

/// ROS camera_info as camera_calibration writes it; it knows no extrinsics.
CameraCalibration read_camera_info(const YAML::Node& root, const Path& file) {
  CameraCalibration camera;
  const std::vector<double> k = number_list(root["camera_matrix"], "data", 9, file);
  set_intrinsics(camera, {k[0], k[4], k[2], k[5]});
  const YAML::Node coefficients = root["distortion_coefficients"];
  set_distortion(camera, root, "distortion_coefficients",
                 coefficients ? coefficients["data"] : coefficients, file);
  camera.width = static_cast<int>(optional_number(root, "image_width", file).value_or(0.0));
  camera.height = static_cast<int>(optional_number(root, "image_height", file).value_or(0.0));
  return camera;
}

void require_plausible(const CameraCalibration& camera, const YAML::Node& root, const Path& file) {
  const bool sizes = camera.width > 0 && camera.height > 0 && camera.fx > 0.0 && camera.fy > 0.0;
  const Eigen::Matrix3d r = camera.body_from_camera.topLeftCorner<3, 3>();
  const bool rotation = (r * r.transpose()).isIdentity(1e-3) && r.determinant() > 0.0;
  if (!sizes) throw yaml_fault(file, root.Mark(), "resolution and intrinsics", "must be > 0");
  if (!rotation) throw yaml_fault(file, root.Mark(), "extrinsics", "are no rotation");
}

std::string number(double value) {
  std::ostringstream text;
  text << std::setprecision(12) << value;
  return text.str();
}

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i > 0 ? ", " : "") + number(values[i]);
  return text + "]";
}

std::string name_of(Distortion lens) {
  switch (lens) {
    case Distortion::kRadialTangential:
      return "radtan";
    case Distortion::kEquidistant:
      return "equidistant";
    case Distortion::kNone:
      break;
  }
  return "none";
}

}  // namespace

Eigen::Matrix4d forward_looking_body_from_camera() {
  Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
  t.topLeftCorner<3, 3>() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return t;
}

void write_camchain(const CameraCalibration& camera, const std::vector<std::string>& remarks,
                    const Path& file) {
  std::ofstream out(file);
  for (const std::string& remark : remarks) out << "# " << remark << "\n";
  out << "cam0:\n"
      << "  camera_model: pinhole\n"
      << "  intrinsics: " << list({camera.fx, camera.fy, camera.cx, camera.cy}) << "\n"
      << "  distortion_model: " << name_of(camera.distortion) << "\n"
      << "  distortion_coeffs: " << list(camera.coefficients) << "\n"
      << "  resolution: [" << camera.width << ", " << camera.height << "]\n";
  if (camera.has_mounting) {
    const Eigen::Matrix4d t = camera.body_from_camera.inverse();
    out << "  T_cam_imu:\n";
    for (int row = 0; row < 4; ++row) {
      out << "  - " << list({t(row, 0), t(row, 1), t(row, 2), t(row, 3)}) << "\n";
    }
    out << "  timeshift_cam_imu: " << number(camera.timeshift_s) << "\n";
  }
  if (camera.height_m) out << "  height_m: " << number(*camera.height_m) << "\n";
  if (camera.pitch_rad) out << "  pitch_rad: " << number(*camera.pitch_rad) << "\n";
  out.flush();
  if (!out) {
    throw fault_at(file, 0, 0, "cannot be written", "choose a folder that exists and has room");
  }
}

CameraCalibration read_camera_calibration(const Path& file) {
  const YAML::Node root = load_yaml(file);
  CameraCalibration camera;
  if (root.IsMap() && root["cam0"]) {
    camera = read_kalibr(root["cam0"], file);
  } else if (root.IsMap() && root["camera_matrix"]) {
    camera = read_camera_info(root, file);
  } else if (root.IsMap() && root["intrinsics"]) {
    camera = read_euroc(root, file);
  } else {
    throw fault_at(file, 1, 1, "no camera calibration",
                   "expected EuRoC sensor.yaml, Kalibr camchain.yaml or ROS camera_info");
  }
  require_plausible(camera, root, file);
  return camera;
}

}  // namespace vpdr::dataset
