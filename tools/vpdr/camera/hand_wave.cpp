#include "vpdr/camera/hand_wave.hpp"

#include <Eigen/Geometry>
#include <cstdio>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "vision/core/calibration/visual_turns.hpp"
#include "vision/source/image_file.hpp"
#include "vision/source/make_camera.hpp"

namespace vpdr::tool {

vision::CameraImuCalibration calibrate_hand_wave(const std::filesystem::path& folder,
                                                 const dataset::CameraCalibration& camera,
                                                 const std::function<void(double)>& progress) {
  const dataset::Recording recording = dataset::read_recording(folder, {.truth = false});
  if (recording.images.empty() || recording.imu.empty()) {
    throw FileFault(folder.string() +
                    ": a hand wave needs images and imu0/data.csv, recorded together");
  }
  vision::VisualTurns seen({}, vision::make_camera(camera));
  std::vector<vision::VisualTurn> turns;
  std::size_t done = 0;
  for (const dataset::ImageEntry& entry : recording.images) {
    const auto image = vision::read_image(entry.file);
    if (image) {
      if (const auto turn = seen.add(image.value(), entry.stamp_ns)) turns.push_back(*turn);
    }
    progress(static_cast<double>(++done) / static_cast<double>(recording.images.size()));
  }
  const auto result = vision::align_camera_imu(turns, recording.imu, {});
  if (!result) throw FileFault(folder.string() + ": " + result.error().message);
  return result.value();
}

void set_mounting(const vision::CameraImuCalibration& mounting,
                  dataset::CameraCalibration& camera) {
  if (!camera.has_mounting) camera.body_from_camera.setIdentity();
  camera.body_from_camera.topLeftCorner<3, 3>() = mounting.imu_from_camera;
  camera.has_mounting = true;
  camera.timeshift_s = mounting.timeshift_s;
}

std::string describe(const vision::CameraImuCalibration& m) {
  const Eigen::Vector3d sigma = m.rotation_sigma_rad;
  const Eigen::Vector3d axis = m.imu_from_camera.col(2);
  char text[400];
  std::snprintf(text, sizeof text,
                "camera looks along (%.4f, %.4f, %.4f) of the inertial sensor, turned about it by "
                "+- %.3f, %.3f, %.3f deg (x, y, z)\nclock: inertial time = frame's stamp %+.2f ms "
                "+- %.2f ms\n%zu turns between frames, RMS %.3f deg, %zu set aside\n",
                axis.x(), axis.y(), axis.z(), to_degrees(sigma.x()), to_degrees(sigma.y()),
                to_degrees(sigma.z()), 1e3 * m.timeshift_s, 1e3 * m.timeshift_sigma_s, m.turns,
                to_degrees(m.rms_rad), m.outliers);
  return text;
}

}  // namespace vpdr::tool
