#include "bench/rendered_room.hpp"

#include <cstdio>

#include "bench/odometry_figures.hpp"
#include "bench/vision_figures.hpp"
#include "core/rotation.hpp"
#include "simulation/path_walk.hpp"
#include "simulation/render/film.hpp"
#include "vision/core/heading/vanishing_point_heading.hpp"
#include "vision/source/simulated_source.hpp"

namespace vpdr::bench {
namespace {

namespace fs = std::filesystem;
using namespace vision;  // NOLINT: a program, not a library
using Eigen::Vector3d;

constexpr std::size_t kHeadingEvery = 2;  // frames: 10 a second

/// The left camera of TUM-VI, as published with the data: camera from the sensor's axes.
simulation::Camera tumvi_camera() {
  simulation::Camera camera;
  camera.width = camera.height = 512;
  camera.lens = simulation::Lens::kEquidistant;
  camera.fx = 190.97847715128717;
  camera.fy = 190.9733070521226;
  camera.cx = 254.93170605935475;
  camera.cy = 256.8974428996504;
  camera.distortion = {0.0034823894022493434, 0.0007150348452162257, -0.0020532361418706202,
                       0.00020293673591811182, 0.0};
  Eigen::Isometry3d camera_from_sensor = Eigen::Isometry3d::Identity();
  camera_from_sensor.matrix().topRows<3>() << -0.9995250378696743, 0.029615343885863205,
      -0.008522328211654736, 0.04727988224914392, 0.0075019185074052044, -0.03439736061393144,
      -0.9993800792498829, -0.047443232143367084, -0.02989013031643309, -0.998969345370175,
      0.03415885127385616, -0.0681999605066297;
  camera.body_from_camera = camera_from_sensor.inverse();
  return camera;
}

simulation::PathWalk read_room(const fs::path& folder, int number) {
  const std::string name = "room" + std::to_string(number);
  simulation::PathWalkOptions options;
  options.path = folder / (name + "_gt.csv");
  options.imu = folder / (name + "_imu.csv");
  options.camera = tumvi_camera();
  options.body_from_sensor = dataset::mount_from_axes("-y", "+z");  // forward as the camera looks
  options.room.seed = static_cast<std::uint64_t>(number);
  return read_path_walk(options);
}

std::vector<ImuSample> in_body_axes(std::vector<ImuSample> samples, const Eigen::Matrix3d& mount) {
  for (ImuSample& sample : samples) {
    sample.angular_velocity_radps = mount * sample.angular_velocity_radps;
    sample.specific_force_mps2 = mount * sample.specific_force_mps2;
  }
  return samples;
}

/// Heading of the optical axis, as VanishingPointHeading has it.
double heading_of(const Eigen::Isometry3d& world_from_camera) {
  const Vector3d axis = world_from_camera.linear().col(2);
  return std::atan2(axis.y(), axis.x());
}

/// One room under way.
class Room {
 public:
  Room(const fs::path& folder, int number)
      : walk_(read_room(folder, number)),
        film_(walk_.shot),
        imu_(in_body_axes(walk_.imu, walk_.body_from_sensor)),
        attitudes_(imu_, no_field_),
        camera_(camera_in_body()),
        odometry_(config(), {}, camera_),
        heading_({}, camera_) {}

  void run(std::ofstream* csv) {
    for (std::size_t k = 0; k < film_.count(); ++k) {
      const TimestampNs stamp = film_.stamp(k);
      const cv::Mat image = film_.image(k);
      const auto attitude = attitudes_.at(stamp);
      look_for_motion({image, stamp, attitude, std::nullopt}, csv);
      if (k % kHeadingEvery == 0) look_for_heading(image, stamp, attitude);
    }
  }

  void print(int number) const {
    std::printf("tumvi_room%d, pictures rendered along %.1f m in %.1f s: %zu frames\n", number,
                walk_.path.length_m(), to_seconds(walk_.path.end_ns() - walk_.path.begin_ns()),
                film_.count());
    std::printf("  heading from vanishing points: found in %d of %d frames\n", found_, looked_);
    line_rate_.print("heading rate error deg/s, vanishing points");
    point_rate_.print("heading rate error deg/s, points");
    errors_.print();
    drift_.print();
    std::printf("  scale: floor %lu, steps %lu, refused %lu, sigma %.3f\n",
                odometry_.scale().floor_looks(), odometry_.scale().step_looks(),
                odometry_.scale().refused(), odometry_.scale().sigma_share());
    print_outcomes(odometry_);
    times_.print();
  }

 private:
  [[nodiscard]] Eigen::Isometry3d body_from_sensor() const {
    Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
    mount.linear() = walk_.body_from_sensor;
    return mount;
  }
  [[nodiscard]] CameraModel camera_in_body() const {
    simulation::Camera camera = walk_.shot.camera;
    camera.body_from_camera = body_from_sensor() * camera.body_from_camera;
    return make_camera(camera);
  }
  [[nodiscard]] Eigen::Isometry3d body_at(TimestampNs stamp) const {
    return walk_.path.at(stamp) * body_from_sensor().inverse();
  }
  /// The floor is the place's z = 0; the hand holds the camera about as high as at the start.
  [[nodiscard]] OdometryConfig config() const {
    OdometryConfig config;
    config.scale.camera_height_m =
        walk_.shot.world_from_camera(walk_.shot.frames.front()).translation().z();
    config.scale.height_share = 0.1;
    return config;
  }

  void look_for_motion(const OdometryInput& input, std::ofstream* csv) {
    for (const StepEvent& step : attitudes_.steps) odometry_.add(step);
    attitudes_.steps.clear();
    const OdometryOutput out = times_(odometry_, input);
    const Eigen::Isometry3d here = body_at(input.stamp_ns);
    if (out.odometry) drift_.add(*out.odometry, here);
    if (!out.motion) return;
    const Eigen::Isometry3d moved = body_at(out.motion->interval_start_ns).inverse() * here;
    const double dt_s = to_seconds(input.stamp_ns - out.motion->interval_start_ns);
    const TrueMotion truth{moved.translation(), Eigen::Quaterniond(moved.linear())};
    errors_.add(*out.motion, truth, moved.translation().norm() / dt_s, csv);
    // About the vertical, in the axes of the interval's start.
    const Vector3d off =
        log_rotation((out.motion->rotation * truth.rotation.conjugate()).normalized());
    const Vector3d up =
        body_at(out.motion->interval_start_ns).linear().transpose() * Vector3d::UnitZ();
    const double variance = up.dot(out.motion->covariance.bottomRightCorner<3, 3>() * up);
    point_rate_.add(off.dot(up) / dt_s, std::sqrt(variance) / dt_s);
  }

  void look_for_heading(const cv::Mat& image, TimestampNs stamp,
                        const std::optional<AttitudePrior>& attitude) {
    const VisionOutput out = heading_.process(image, stamp, attitude);
    ++looked_;
    found_ += out.heading.found ? 1 : 0;
    if (!out.rate) return;
    const double turned =
        wrap_pi(heading_of(walk_.shot.world_from_camera(stamp)) -
                heading_of(walk_.shot.world_from_camera(out.rate->interval_start_ns)));
    const double true_rate = turned / to_seconds(stamp - out.rate->interval_start_ns);
    line_rate_.add(out.rate->rate_radps - true_rate, out.rate->sigma_radps);
  }

  simulation::PathWalk walk_;
  simulation::Film film_;
  std::vector<ImuSample> imu_;
  std::vector<MagSample> no_field_;
  AttitudesOf attitudes_;
  CameraModel camera_;
  VisualOdometry odometry_;
  VanishingPointHeading heading_;
  MotionErrors errors_;
  DriftErrors drift_;
  OdometryTimes times_;
  Errors line_rate_, point_rate_;
  int found_ = 0, looked_ = 0;
};

}  // namespace

void tumvi_room(const fs::path& folder, int number, std::ofstream* csv) {
  Room room(folder, number);
  room.run(csv);
  room.print(number);
}

}  // namespace vpdr::bench
