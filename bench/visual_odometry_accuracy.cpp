// How well visual odometry does on real images, and how long it takes:
//   bench_visual_odometry_accuracy [DATA] [--csv FILE] [--only SET]
//   simulated             a walk through rendered corridors
//   euroc_mh01            shaken by hand, then still; true pose. With the gyroscope and without
//   corridor_rgbd_lpvo    a walk along corridors; depth every fifth image gives true lengths
//   tumvi_rooms           carried by hand in a room: recorded samples, pictures rendered along the
//                         reference
// Times are processor time of one core; bare: CLAHE, optical flow and corners of OpenCV alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bench/odometry_figures.hpp"
#include "bench/rendered_room.hpp"
#include "bench/sets.hpp"
#include "bench/vision_figures.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "simulation/walk_camera.hpp"
#include "vision/core/heading/vanishing_point_heading.hpp"
#include "vision/core/odometry/visual_odometry.hpp"
#include "vision/source/image_file.hpp"
#include "vision/source/make_camera.hpp"
#include "vision/source/simulated_source.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;          // NOLINT: a program, not a header
using namespace vpdr::vision;  // NOLINT
using namespace vpdr::bench;   // NOLINT

// ------------------------------------------------------------------------------- EuRoC

void euroc(const fs::path& folder, bool with_gyro, std::ofstream* csv) {
  dataset::Recording recording = dataset::read_recording(folder);
  recording.truth.poses = read_tum(folder / "gt/groundtruth_tum.txt");
  OdometryConfig config;
  VisualOdometry odometry(config, {}, make_camera(*recording.camera));
  AttitudesOf attitudes(recording.imu, recording.mag);
  MotionErrors errors;
  OdometryTimes times;
  int still_found = 0, still = 0, moving_called_still = 0, moving = 0, frames = 0;
  for (const dataset::ImageEntry& entry : recording.images) {
    const auto image = read_image(entry.file);
    if (!image) continue;
    ++frames;
    OdometryInput input{image.value(), entry.stamp_ns, std::nullopt, std::nullopt};
    if (with_gyro) input.attitude = attitudes.at(entry.stamp_ns);
    const OdometryOutput out = times(odometry, input);
    const auto speed = speed_at(recording.truth.poses, entry.stamp_ns);
    if (!speed) continue;
    const bool is_still = out.outcome == MotionOutcome::kStill;
    still += *speed < 0.02 ? 1 : 0;
    still_found += *speed < 0.02 && is_still ? 1 : 0;
    moving += *speed > 0.1 ? 1 : 0;
    moving_called_still += *speed > 0.1 && is_still ? 1 : 0;
    if (!out.motion) continue;
    const auto truth =
        relative_truth(recording.truth.poses, out.motion->interval_start_ns, out.motion->stamp_ns);
    if (truth) errors.add(*out.motion, *truth, *speed, csv);
  }
  std::printf("euroc_mh01, %s: %d frames\n", with_gyro ? "with gyroscope" : "images only", frames);
  errors.print();
  std::printf("  still: found in %d of %d frames; called still while moving: %d of %d\n",
              still_found, still, moving_called_still, moving);
  if (with_gyro) {
    std::printf("  gyroscope's remaining bias rad/s: %.4f %.4f %.4f\n",
                odometry.gyro_bias_radps().x(), odometry.gyro_bias_radps().y(),
                odometry.gyro_bias_radps().z());
  }
  print_outcomes(odometry);
  times.print();
}

// ------------------------------------------------------------------------------- LPVO corridor

void corridor(const fs::path& folder) {
  CameraParameters p;
  p.width_px = 640;
  p.height_px = 480;
  p.fx_px = 537.59990753;
  p.fy_px = 539.03332443;
  p.cx_px = 316.14867396;
  p.cy_px = 245.51866763;
  p.distortion = Distortion::kRadialTangential;
  p.coefficients = {0.03542659, -0.04764800, 0.00107085, 0.00126616, -0.20704202};
  const CameraModel camera(p);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "rgb")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  VanishingPointHeading directions({}, camera);
  OdometryConfig config;
  const FloorSeen floor = floor_from_depth(folder / "depth", camera, files, 3);
  config.scale.camera_height_m = floor.height_m;
  std::printf("corridor_rgbd_lpvo: camera height %.3f m from the depth of the first %d frames\n",
              floor.height_m, floor.frames);
  VisualOdometry odometry(config, {}, camera);
  DepthReference reference(folder / "depth", camera);
  ScaleErrors errors;
  OdometryTimes times;
  TimestampNs stamp = 0;
  for (const fs::path& file : files) {
    stamp += kNsPerSecond / 15;
    const auto image = read_image(file);
    if (!image) continue;
    const VisionOutput seen = directions.process(image.value(), stamp, std::nullopt);
    OdometryInput input{image.value(), stamp, std::nullopt, std::nullopt};
    if (seen.outcome == FrameOutcome::kFound) {
      input.up_camera = seen.frame->camera_from_corridor.col(2);
    }
    const OdometryOutput out = times(odometry, input);
    errors.add(out, reference.follow(file, odometry.tracks()));
  }
  errors.print();
  std::printf("  scale: floor %lu, refused %lu, sigma %.3f\n", odometry.scale().floor_looks(),
              odometry.scale().refused(), odometry.scale().sigma_share());
  print_outcomes(odometry);
  times.print();
}

// ------------------------------------------------------------------------------- simulation

void simulated(bool by_floor) {
  simulation::WalkOptions options;
  options.duration_s = 60.0;
  options.camera_rate_hz = 20.0;
  const simulation::WalkCamera pictures(simulation::simulate_walk(options));
  const simulation::SimulatedWalk& walk = pictures.walk();
  OdometryConfig config;
  if (by_floor) {
    config.scale.camera_height_m = walk.world_from_camera(walk.frames.front()).translation().z();
  }
  VisualOdometry odometry(config, {}, make_camera(options.camera));
  AttitudesOf attitudes(walk.imu, walk.mag, pdr::carry_named(name_of(options.worn)));
  DriftErrors drift;
  MotionErrors errors;
  OdometryTimes times;
  for (std::size_t k = 0; k < pictures.count(); ++k) {
    const TimestampNs stamp = pictures.stamp(k);
    const OdometryInput input{pictures.image(k), stamp, attitudes.at(stamp), std::nullopt};
    for (const StepEvent& step : attitudes.steps) odometry.add(step);
    attitudes.steps.clear();
    const OdometryOutput out = times(odometry, input);
    const auto truth = [&](TimestampNs at) {
      const simulation::MotionState state = walk.state_at(at);
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = state.world_from_body.toRotationMatrix();
      pose.translation() = state.position_m;
      return pose;
    };
    if (out.odometry) drift.add(*out.odometry, truth(stamp));
    if (!out.motion) continue;
    const Eigen::Isometry3d moved = truth(out.motion->interval_start_ns).inverse() * truth(stamp);
    errors.add(*out.motion, {moved.translation(), Eigen::Quaterniond(moved.linear())},
               moved.translation().norm() / to_seconds(stamp - out.motion->interval_start_ns),
               nullptr);
  }
  std::printf("simulated walk, scale by %s:\n", by_floor ? "the floor" : "steps");
  errors.print();
  drift.print();
  std::printf("  scale: floor %lu, steps %lu, refused %lu, sigma %.3f\n",
              odometry.scale().floor_looks(), odometry.scale().step_looks(),
              odometry.scale().refused(), odometry.scale().sigma_share());
  print_outcomes(odometry);
  times.print();
}

}  // namespace

int main(int argc, char** argv) {
  return run_sets(
      argc, argv,
      {{"simulated", "",
        [](const fs::path&, std::ofstream*) {
          simulated(true);
          simulated(false);
        }},
       {"euroc_mh01", "vision/euroc_mh01",
        [](const fs::path& folder, std::ofstream* csv) {
          euroc(folder, true, csv);
          euroc(folder, false, csv);
        }},
       {"corridor_rgbd_lpvo", "vision/corridor_rgbd_lpvo",
        [](const fs::path& folder, std::ofstream*) { corridor(folder); }},
       {"tumvi_rooms", "trajectories/tumvi_rooms", [](const fs::path& folder, std::ofstream* csv) {
          for (const int room : {1, 3, 5}) tumvi_room(folder, room, csv);
        }}});
}
