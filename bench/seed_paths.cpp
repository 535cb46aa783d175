// The AHRS paper's own two tests (S3.8), walked again in the simulator with its sensors (S3.7: 20
// Hz, MPU6050, HMC5883L) at the chest, for vpdr with its default configuration and for plain PDR
// (gyroscope-integrated heading, fixed step, same step detector):
//   bench_seed_paths [--seeds N]
// Path A: 15 s at 1.53 steps/s, one turn. Path B: 34 s at 1.74 steps/s, many turns. Both methods
// are told the walker's mean step, as the paper's fuzzy rule knows its subject's; plain PDR is told
// the true heading at the start as well. The paper does not describe its field: an undisturbed one
// and that of the simulated building are both walked.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"
#include "simulation/walk.hpp"

namespace {

using namespace vpdr;  // NOLINT: a program, not a header
using Eigen::Vector2d;

struct Path {
  std::string name;
  double walked_s;
  double steps_per_s;
  std::vector<Vector2d> corners_m;
  double steps_goal_percent;
  double heading_goal_deg;
  double position_goal_m;
};

std::vector<Path> paths() {
  return {{"path A", 15.0, 1.53, {{0, 0}, {8, 0}, {8, 12}}, 0.0, 2.0, 0.2},
          {"path B",
           34.0,
           1.74,
           {{0, 0}, {6, 0}, {6, 6}, {12, 6}, {12, 0}, {18, 0}, {18, 6}, {24, 6}, {24, 0}, {30, 0}},
           2.0,
           5.0,
           0.5}};
}

simulation::SensorErrors seed_board() {
  simulation::SensorErrors errors;
  // Data sheets: MPU6050 400 ug/rtHz and 0.005 deg/s/rtHz; HMC5883L 0.2 uT RMS at 20 Hz. Biases as
  // a calibration leaves them.
  errors.accelerometer = {3.9e-3, 0.05, 1.0e-4, 0.003, 0.003, 4.0 * kGravityMps2 / 32768.0};
  errors.gyroscope = {8.7e-5, 0.005, 2.0e-5, 0.003, 0.003, 8.7266 / 32768.0};
  errors.magnetometer = {0.06, 0.5, 0.002, 0.006, 0.004, 0.092};
  return errors;
}

simulation::SimulatedWalk walk(const Path& path, std::uint64_t seed, bool building) {
  simulation::WalkOptions options;
  options.seed = seed;
  options.worn = simulation::WornAt::kChest;
  options.waypoints_m = path.corners_m;
  options.pauses.stop_every_s = 0.0;
  options.duration_s = options.pauses.initial_s + path.walked_s + options.pauses.final_s;
  const double cadence = 60.0 * path.steps_per_s;
  options.walker.preferred_speed_mps =
      cadence * cadence * options.walker.walk_ratio_m_per_spm / 60.0;
  options.imu_rate_hz = 20.0;
  options.mag_rate_hz = 20.0;
  options.pressure_rate_hz = 0.0;
  options.camera_rate_hz = 0.0;
  options.errors = seed_board();
  if (!building) {
    options.field.disturbance_ut = 0.0;
    options.field.objects_per_m = 0.0;
  }
  return simulation::simulate_walk(options);
}

/// What a method says at each step.
struct Track {
  std::vector<TimestampNs> stamps;
  std::vector<Vector2d> places_m;
  std::vector<double> yaws_rad;
};

struct Tracks {
  Track vpdr;
  Track plain;
};

Tracks run(const simulation::SimulatedWalk& walk) {
  pdr::PdrConfig config;
  config.carry = pdr::Carry::kChest;
  config.step_length.model = pdr::StepLengthKind::kLinear;  // the walk's own ratio is known
  config.step_length.alpha_m_per_hz = 60.0 * walk.options.walker.walk_ratio_m_per_spm;
  pdr::Pdr pdr(config);
  pdr::PdrOutput out;
  Tracks tracks;
  double gyro_yaw = yaw_of(walk.state_at(walk.imu.front().stamp_ns).world_from_body);
  double mean_step_m = 0.0;
  for (const auto& step : walk.steps) mean_step_m += step.length_m;
  mean_step_m /= static_cast<double>(walk.steps.size());
  Vector2d plain = Vector2d::Zero();
  TimestampNs last = walk.imu.front().stamp_ns;
  std::size_t mag = 0;
  for (const ImuSample& sample : walk.imu) {
    while (mag < walk.mag.size() && walk.mag[mag].stamp_ns <= sample.stamp_ns) {
      pdr.process(walk.mag[mag++]);
    }
    if (pdr.process(sample, out) != Refusal::kNone) continue;
    gyro_yaw += sample.angular_velocity_radps.z() * to_seconds(sample.stamp_ns - last);
    last = sample.stamp_ns;
    if (!out.step || out.step->status != StepStatus::kConfirmed) continue;
    plain += mean_step_m * Vector2d(std::cos(gyro_yaw), std::sin(gyro_yaw));
    tracks.plain.stamps.push_back(out.step->stamp_ns);
    tracks.plain.places_m.push_back(plain);
    tracks.plain.yaws_rad.push_back(gyro_yaw);
    tracks.vpdr.stamps.push_back(out.step->stamp_ns);
    tracks.vpdr.places_m.emplace_back(pdr.dead_reckoning().position_m());
    tracks.vpdr.yaws_rad.push_back(out.step->yaw_rad);
  }
  return tracks;
}

struct Errors {
  double steps_percent = 0.0;
  double heading_deg = 0.0;  ///< mean
  double mean_m = 0.0;
  double final_m = 0.0;
};

Errors errors_of(const Track& track, const simulation::SimulatedWalk& walk) {
  Errors errors;
  const auto truth = static_cast<double>(walk.steps.size());
  const auto counted = static_cast<double>(track.stamps.size());
  errors.steps_percent = 100.0 * std::abs(counted - truth) / truth;
  if (track.stamps.empty()) return errors;
  const auto place = [&](TimestampNs t) -> Vector2d {
    return walk.state_at(t).position_m.head<2>();
  };
  const Vector2d start = place(walk.imu.front().stamp_ns);
  for (std::size_t i = 0; i < track.stamps.size(); ++i) {
    // Over a stride about the middle of the step: the body sways with each step.
    const TimestampNs period =
        i > 0 ? std::min(track.stamps[i] - track.stamps[i - 1], to_ns(1.0)) : to_ns(0.6);
    const Vector2d moved =
        place(track.stamps[i] + period / 2) - place(track.stamps[i] - 3 * period / 2);
    errors.heading_deg +=
        std::abs(to_degrees(wrap_pi(track.yaws_rad[i] - std::atan2(moved.y(), moved.x()))));
    errors.mean_m += (track.places_m[i] - (place(track.stamps[i]) - start)).norm();
  }
  errors.heading_deg /= counted;
  errors.mean_m /= counted;
  errors.final_m = (track.places_m.back() - (place(walk.imu.back().stamp_ns) - start)).norm();
  return errors;
}

void add(Errors& sum, const Errors& errors, double share) {
  sum.steps_percent += share * errors.steps_percent;
  sum.heading_deg += share * errors.heading_deg;
  sum.mean_m += share * errors.mean_m;
  sum.final_m += share * errors.final_m;
}

void print(const Path& path, bool building, const char* method, const Errors& errors) {
  std::printf("%-8s %-12s %-10s %9.2f %12.2f %9.3f %9.3f\n", path.name.c_str(),
              building ? "building" : "undisturbed", method, errors.steps_percent,
              errors.heading_deg, errors.mean_m, errors.final_m);
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 20;
  CLI::App app("The AHRS paper's two walks in the simulator: vpdr beside plain PDR.");
  app.add_option("--seeds", seeds, "walks of each path")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf("mean of %d walks\n%-8s %-12s %-10s %9s %12s %9s %9s\n", seeds, "", "field", "method",
              "steps %", "heading deg", "mean m", "final m");
  for (const Path& path : paths()) {
    for (const bool building : {false, true}) {
      Errors vpdr;
      Errors plain;
      for (int seed = 1; seed <= seeds; ++seed) {
        const auto walked = walk(path, static_cast<std::uint64_t>(seed), building);
        const Tracks tracks = run(walked);
        add(vpdr, errors_of(tracks.vpdr, walked), 1.0 / seeds);
        add(plain, errors_of(tracks.plain, walked), 1.0 / seeds);
      }
      print(path, building, "vpdr", vpdr);
      print(path, building, "plain PDR", plain);
    }
    std::printf("%-8s %-12s %-10s %9.2f %12.2f %9.3f\n", path.name.c_str(), "", "goal",
                path.steps_goal_percent, path.heading_goal_deg, path.position_goal_m);
  }
  return 0;
}
