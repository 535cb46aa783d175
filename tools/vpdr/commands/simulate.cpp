// vpdr simulate: a walk that nobody walked, or one that nobody filmed, as a recording folder.
#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>

#include "core/errors.hpp"
#include "dataset/recording.hpp"
#include "simulation/recording_writer.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/progress_bar.hpp"

namespace vpdr::tool {
namespace {

struct SimulateOptions {
  std::filesystem::path out;
  simulation::WalkOptions walk;
  std::string worn = "head";
  std::filesystem::path camera;  ///< calibration file
  double frame_rate_hz = 0.0;    ///< 0: the walk's own
  simulation::PathWalkOptions path;
  std::string mount;          ///< "forward,up" of the path's sensor
  bool simulate_imu = false;  ///< along the path
  std::vector<std::string> dark, blank;
  bool no_images = false;
  simulation::RecordingOptions recording;
};

/// "2.5:4" in seconds.
simulation::Stretch parse_stretch(const std::string& text) {
  simulation::Stretch stretch;
  const char *begin = text.data(), *end = begin + text.size();
  const auto from = std::from_chars(begin, end, stretch.from_s);
  if (from.ec == std::errc() && from.ptr != end && *from.ptr == ':') {
    const auto to = std::from_chars(from.ptr + 1, end, stretch.to_s);
    if (to.ec == std::errc() && to.ptr == end) return stretch;
  }
  throw ConfigurationFault("simulate: '" + text +
                           "' is no stretch of time; write FROM:TO, seconds");
}

Eigen::Matrix3d parse_mount(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto mount = comma == std::string::npos
                         ? std::nullopt
                         : dataset::mount_from_axes(text.substr(0, comma), text.substr(comma + 1));
  if (!mount) {
    throw ConfigurationFault("simulate: --mount '" + text +
                             "' does not name two axes; write forward and up as in -y,+z");
  }
  return *mount;
}

/// Writing there would destroy what is read.
void require_apart(const std::filesystem::path& source, const std::filesystem::path& out) {
  if (source.empty()) return;
  const auto way = std::filesystem::weakly_canonical(source).lexically_relative(
      std::filesystem::weakly_canonical(out / ""));
  if (way.empty() || *way.begin() == "..") return;
  throw ConfigurationFault("simulate: --out " + out.string() + " holds " + source.string() +
                           ", which is read; choose another folder");
}

void render_path(SimulateOptions& options) {
  require_apart(options.path.path, options.out);
  require_apart(options.path.imu, options.out);
  if (!options.mount.empty()) options.path.body_from_sensor = parse_mount(options.mount);
  if (!options.camera.empty()) {
    options.path.camera = simulation::camera_of(dataset::read_camera_calibration(options.camera));
  }
  if (options.frame_rate_hz > 0.0) options.path.camera_rate_hz = options.frame_rate_hz;
  options.path.room.seed = options.walk.seed;
  if (options.simulate_imu) {
    simulation::PathImuOptions imu;
    imu.rate_hz = options.walk.imu_rate_hz;
    imu.seed = options.walk.seed;
    options.path.simulated_imu = imu;
  }
  const simulation::PathWalk walk = simulation::read_path_walk(options.path);
  ProgressBar bar(options.no_images ? "writing" : "rendering");
  simulation::write_recording(walk, options.out, options.recording,
                              [&bar](double share) { bar.update(share); });
  std::cout << (options.no_images ? "walk along " : "pictures along ") << walk.source << " in "
            << options.out.string() << ": " << to_seconds(walk.path.end_ns() - walk.path.begin_ns())
            << " s, " << walk.path.length_m() << " m, "
            << (options.no_images ? 0 : walk.shot.frames.size()) << " frames, " << walk.imu.size()
            << " inertial samples\n";
}

void simulate_walk(SimulateOptions& options) {
  using simulation::WornAt;
  options.walk.worn = options.worn == "chest"   ? WornAt::kChest
                      : options.worn == "waist" ? WornAt::kWaist
                                                : WornAt::kHead;
  if (!options.camera.empty()) {
    const auto calibration = dataset::read_camera_calibration(options.camera);
    const Eigen::Isometry3d ahead = options.walk.camera.body_from_camera;
    options.walk.camera = simulation::camera_of(calibration);
    if (!calibration.has_mounting) options.walk.camera.body_from_camera = ahead;
  }
  if (options.frame_rate_hz > 0.0) options.walk.camera_rate_hz = options.frame_rate_hz;
  const simulation::SimulatedWalk walk = simulation::simulate_walk(options.walk);
  ProgressBar bar(options.no_images ? "writing" : "rendering");
  simulation::write_recording(walk, options.out, options.recording,
                              [&bar](double share) { bar.update(share); });
  std::cout << "simulated walk in " << options.out.string() << ": " << options.walk.duration_s
            << " s, " << walk.steps.size() << " steps, seed " << options.walk.seed << "\n";
}

void simulate(SimulateOptions options) {
  options.recording.images = !options.no_images;
  for (const std::string& s : options.dark) options.recording.film.dark.push_back(parse_stretch(s));
  for (const std::string& s : options.blank) {
    options.recording.film.blank.push_back(parse_stretch(s));
  }
  if (options.path.path.empty()) {
    simulate_walk(options);
  } else {
    render_path(options);
  }
}

void add_walk_options(CLI::App& command, SimulateOptions& options) {
  command.add_option("--out", options.out, "folder of the recording")->required();
  command.add_option("--seed", options.walk.seed, "the same seed gives the same walk")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--duration", options.walk.duration_s, "length, s")
      ->check(CLI::Range(5.0, 7200.0))
      ->capture_default_str();
  command.add_option("--imu-rate", options.walk.imu_rate_hz, "inertial samples a second")
      ->check(CLI::Range(20.0, 2000.0))
      ->capture_default_str();
  command.add_option("--worn", options.worn, "where the board is worn")
      ->check(CLI::IsMember({"head", "chest", "waist"}))
      ->capture_default_str();
  command
      .add_option(
          "--storeys", options.walk.building.storeys,
          "of the building; with two and more the walk takes the stairs where there is time")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  command.add_flag("--draw-walker", options.walk.draw_walker,
                   "a random adult instead of the average one");
}

void add_path_options(CLI::App& command, SimulateOptions& options) {
  const std::string group = "A recorded path instead of a simulated walk";
  CLI::Option* path =
      command
          .add_option("--path", options.path.path,
                      "recording with a reference, or file of poses (groundtruth.csv, TUM .txt): "
                      "its samples are kept, pictures are rendered along it")
          ->check(CLI::ExistingPath)
          ->group(group);
  CLI::Option* imu =
      command.add_option("--imu", options.path.imu, "inertial samples beside a file of poses")
          ->check(CLI::ExistingFile)
          ->needs(path)
          ->group(group);
  command
      .add_flag("--simulate-imu", options.simulate_imu,
                "simulated inertial samples along the path, which becomes a smooth curve")
      ->needs(path)
      ->excludes(imu)
      ->group(group);
  command
      .add_flag("--raw-path{false}", options.path.smooth,
                "follow the reference as it is, with its noise from pose to pose")
      ->needs(path)
      ->group(group);
  command.add_option("--mount", options.mount, "sensor axes forward and up, as in -y,+z")
      ->needs(path)
      ->group(group);
}

void add_camera_options(CLI::App& command, SimulateOptions& options) {
  const std::string group = "Camera and pictures";
  simulation::FilmOptions& film = options.recording.film;
  const auto number = [&](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)->capture_default_str()->group(group);
  };
  command.add_flag("--no-images", options.no_images, "samples and truth only; much quicker")
      ->group(group);
  command
      .add_option("--camera", options.camera,
                  "calibration (camchain.yaml, sensor.yaml, camera_info.yaml) of the camera, "
                  "pinhole or fisheye")
      ->check(CLI::ExistingFile)
      ->group(group);
  command.add_option("--frame-rate", options.frame_rate_hz, "pictures a second [10, 20 on a path]")
      ->check(CLI::Range(0.1, 200.0))
      ->group(group);
  command
      .add_flag("--depth", options.recording.depth,
                "true depth too: depth0/data, 16-bit millimetres")
      ->group(group);
  number("--exposure", film.exposure_s, "shutter time, s: motion blur; 0: none");
  number("--exposure-swing", film.exposure_swing_ev, "slow changes of brightness, stops");
  number("--read-noise", film.render.sensor.read_noise, "noise in the dark, grey levels");
  number("--shot-noise", film.render.sensor.shot_noise, "variance added by each grey level");
  number("--vignetting", film.render.sensor.vignetting, "loss of light in the corners, share");
  number("--passers-by", film.passers_by_per_min, "people met a minute");
  command.add_option("--dark", options.dark, "stretches FROM:TO, s, with the lamps off")
      ->group(group);
  command.add_option("--blank", options.blank, "stretches FROM:TO, s, with a blank wall in view")
      ->group(group);
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(
      "simulate",
      "Write a simulated walk through corridors, or pictures along a recorded path, with truth and "
      "camera, as a recording.");
  add_walk_options(*command, *options);
  add_path_options(*command, *options);
  add_camera_options(*command, *options);
  command->callback([options] { simulate(*options); });
}

}  // namespace vpdr::tool
