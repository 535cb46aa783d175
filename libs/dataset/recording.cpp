#include "dataset/recording.hpp"

#include "dataset/about.hpp"
#include "dataset/sample_tables.hpp"
#include "dataset/text_file.hpp"
#include "dataset/truth_tables.hpp"

namespace vpdr::dataset {
namespace {

using Path = std::filesystem::path;

/// The first of `names` under `folder` that exists, plain or xz.
std::optional<Path> find_first(const Path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (auto found = find_plain_or_xz(folder / name)) return found;
  }
  return std::nullopt;
}

void read_samples(const Path& root, Recording& recording) {
  ReadReport& report = recording.report;
  if (const auto file = find_first(root, {"imu0/data.csv"})) {
    recording.imu = read_imu_table(*file, report);
    if (!recording.imu.front().has_angular_velocity) {
      report.notes.push_back(file->string() + ": no gyroscope in this recording");
    }
  }
  if (const auto file = find_first(root, {"mag0/data.csv"})) {
    recording.mag = read_mag_table(*file, report);
  }
  if (const auto file = find_first(root, {"baro0/data.csv"})) {
    recording.pressure = read_pressure_table(*file, report);
  }
}

void read_images(const Path& root, const ReadOptions& options, Recording& recording) {
  ReadReport& report = recording.report;
  if (const auto file = find_first(root, {"cam0/data.csv"})) {
    recording.images = read_image_table(*file, root / "cam0" / "data", report);
    return;
  }
  recording.video = find_first(root, {"cam0.mp4", "cam0.avi", "cam0.mkv", "video.mp4", "video.avi",
                                      "video.mkv", "video.mov"});
  if (recording.video) return;
  for (const char* name : {"cam0/data", "rgb", "images", "."}) {
    const Path folder = (root / name).lexically_normal();
    if (!std::filesystem::is_directory(folder)) continue;
    recording.images = list_images(folder, options.nominal_image_rate_hz, report);
    if (!recording.images.empty()) return;
  }
}

void read_calibration(const Path& folder, const Path& root, Recording& recording) {
  if (recording.about.camera) {
    recording.camera = read_camera_calibration(*recording.about.camera);
    return;
  }
  for (const Path& file : {root / "cam0" / "sensor.yaml", folder / "camchain.yaml",
                           root / "cam0" / "camchain.yaml", folder / "camera_info.yaml"}) {
    if (!std::filesystem::is_regular_file(file)) continue;
    recording.camera = read_camera_calibration(file);
    return;
  }
}

void read_truth(const Path& folder, const Path& root, Recording& recording) {
  ReadReport& report = recording.report;
  Truth& truth = recording.truth;
  if (const auto csv = find_first(folder, {"groundtruth.csv"})) {
    truth.poses = read_groundtruth_table(*csv, report);
  } else if (const auto tum = find_first(folder, {"gt/groundtruth_tum.txt", "groundtruth.txt"})) {
    truth.poses = read_tum(*tum, report);
  } else if (const auto asl = find_first(root, {"state_groundtruth_estimate0/data.csv"})) {
    truth.poses = read_groundtruth_table(*asl, report);
  }
  if (const auto file = find_first(folder, {"movement.csv"})) {
    truth.movement = read_movement_table(*file, report);
  }
  if (const auto file = find_first(folder, {"waypoints.csv"})) {
    truth.waypoints = read_waypoint_table(*file, report);
  }
  if (const auto file = find_first(folder, {"steps.csv"})) {
    truth.steps = read_step_table(*file, report);
  } else if (const auto json = find_first(folder, {"reference.json"})) {
    const TimestampNs start_ns = recording.imu.empty() ? 0 : recording.imu.front().stamp_ns;
    read_step_reference(*json, start_ns, truth, report);
  }
}

std::string name_of_folder(const Path& folder) {
  const Path normal = std::filesystem::absolute(folder).lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

}  // namespace

Recording read_recording(const Path& folder, const ReadOptions& options) {
  if (!std::filesystem::is_directory(folder)) {
    throw fault_at(folder, 0, 0, "no such folder", "give the folder of a recording");
  }
  Recording recording;
  recording.folder = folder;
  recording.name = name_of_folder(folder);
  const Path root = std::filesystem::is_directory(folder / "mav0") ? folder / "mav0" : folder;
  if (const auto about = find_first(folder, {"about.yaml"})) recording.about = read_about(*about);
  if (options.mount) recording.about.mount = *options.mount;
  read_samples(root, recording);
  if (options.images) read_images(root, options, recording);
  if (recording.imu.empty() && recording.images.empty() && !recording.video) {
    throw fault_at(folder, 0, 0, "holds neither imu0/data.csv[.xz] nor images",
                   "give the folder of a recording (docs/recordings.md)");
  }
  if (options.images && (!recording.images.empty() || recording.video)) {
    read_calibration(folder, root, recording);
  }
  if (options.truth) read_truth(folder, root, recording);
  return recording;
}

void apply_mount(Recording& recording) {
  const Eigen::Matrix3d& body_from_sensor = recording.about.mount;
  for (ImuSample& sample : recording.imu) {
    sample.specific_force_mps2 = body_from_sensor * sample.specific_force_mps2;
    sample.angular_velocity_radps = body_from_sensor * sample.angular_velocity_radps;
  }
  for (MagSample& sample : recording.mag) sample.field_ut = body_from_sensor * sample.field_ut;
  const Eigen::Quaterniond sensor_from_body(body_from_sensor.transpose());
  for (TruthPose& pose : recording.truth.poses) {
    pose.world_from_sensor = pose.world_from_sensor * sensor_from_body;
  }
  if (recording.camera && recording.camera->has_mounting) {
    Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
    turn.topLeftCorner<3, 3>() = body_from_sensor;
    recording.camera->body_from_camera = turn * recording.camera->body_from_camera;
  }
  recording.about.mount.setIdentity();
}

}  // namespace vpdr::dataset
