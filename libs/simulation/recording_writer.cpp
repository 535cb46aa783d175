#include "simulation/recording_writer.hpp"

#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <fstream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/text_output.hpp"

namespace vpdr::simulation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDataset = "dataset: \"vpdr simulated walk\"";

bool holds_simulated_walk(const fs::path& folder) {
  std::ifstream about(folder / "about.yaml");
  std::string line;
  return std::getline(about, line) && line == kDataset;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) cannot_write(folder, error.message());
}

void prepare(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    if (!fs::is_directory(folder, error) || !holds_simulated_walk(folder)) {
      throw FileFault(folder.string() +
                      ": holds something else than a simulated walk; choose another folder or "
                      "remove it");
    }
    for (const char* part :
         {"imu0", "mag0", "baro0", "cam0", "depth0", "groundtruth.csv", "steps.csv"}) {
      fs::remove_all(folder / part, error);
      if (error) cannot_write(folder / part, error.message());
    }
  }
  make_folder(folder);
}

/// Of the sensor's axes the one along a direction.
const char* axis_name(const Eigen::Vector3d& direction) {
  constexpr const char* kNames[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return kNames[2 * axis + (direction[axis] < 0.0 ? 1 : 0)];
}

void write_about(const SimulatedWalk& walk, const RecordingOptions& options, const fs::path& file) {
  const WalkOptions& o = walk.options;
  TextOutput out(file);
  out.print("%s\n", kDataset);
  out.print("seed: %" PRIu64 "\nduration_s: %g\n", o.seed, o.duration_s);
  out.print("carry: \"%s\"\nmount: {forward: \"+x\", up: \"+z\"}\n", name_of(o.worn));
  out.print("rate_hz: %g\nheight_cm: %.1f\n", o.imu_rate_hz, 100.0 * o.walker.height_m);
  out.print("preferred_speed_mps: %g\nwalk_ratio_m_per_spm: %g\n", o.walker.preferred_speed_mps,
            o.walker.walk_ratio_m_per_spm);
  out.print("declination_deg: %g\nmagnetic_disturbance: false\n",
            to_degrees(o.field.declination_rad));
  out.print("true_steps: %zu\ntrue_distance_m: %.3f\n", walk.steps.size(), walk.distance_m);
  if (options.images && !walk.frames.empty()) out.print("camera: cam0/sensor.yaml\n");
  out.print("note: \"truth is exact; the field bends indoors by a few microtesla\"\n");
  out.finish();
}

void write_about(const PathWalk& walk, const RecordingOptions& options, const fs::path& file) {
  TextOutput out(file);
  out.print("%s\n", kDataset);
  out.print("trial: \"%s\"\nseed: %" PRIu64 "\n", walk.source.c_str(), walk.shot.seed);
  out.print("mount: {forward: \"%s\", up: \"%s\"}\n", axis_name(walk.body_from_sensor.row(0)),
            axis_name(walk.body_from_sensor.row(2)));
  out.print("declination_deg: %g\ntrue_distance_m: %.3f\n", to_degrees(walk.declination_rad),
            walk.path.length_m());
  if (options.images && !walk.shot.frames.empty()) out.print("camera: cam0/sensor.yaml\n");
  out.print("note: \"pictures rendered along a recorded reference; the samples are %s\"\n",
            walk.simulated_imu ? "simulated" : "recorded");
  out.finish();
}

void write_imu(const std::vector<ImuSample>& samples, const fs::path& folder) {
  if (samples.empty()) return;
  make_folder(folder);
  TextOutput out(folder / "data.csv");
  out.print(
      "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z "
      "[m/s^2]\n");
  for (const ImuSample& s : samples) {
    const auto &w = s.angular_velocity_radps, &a = s.specific_force_mps2;
    out.print("%" PRId64 ",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", s.stamp_ns, w.x(), w.y(), w.z(), a.x(),
              a.y(), a.z());
  }
  out.finish();
}

void write_mag(const std::vector<MagSample>& samples, const fs::path& folder) {
  if (samples.empty()) return;
  make_folder(folder);
  TextOutput out(folder / "data.csv");
  out.print("#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]\n");
  for (const MagSample& s : samples) {
    out.print("%" PRId64 ",%.7g,%.7g,%.7g\n", s.stamp_ns, s.field_ut.x(), s.field_ut.y(),
              s.field_ut.z());
  }
  out.finish();
}

void write_pressure(const std::vector<PressureSample>& samples, const fs::path& folder) {
  if (samples.empty()) return;
  make_folder(folder);
  TextOutput out(folder / "data.csv");
  out.print("#timestamp [ns],pressure [Pa]\n");
  for (const PressureSample& s : samples) {
    out.print("%" PRId64 ",%.9g\n", s.stamp_ns, s.pressure_pa);
  }
  out.finish();
}

void write_truth(const std::vector<PathPose>& poses, const fs::path& file) {
  TextOutput out(file);
  out.print("#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n");
  for (const PathPose& pose : poses) {
    const auto& p = pose.position_m;
    const auto& q = pose.world_from_body;
    out.print("%" PRId64 ",%.6f,%.6f,%.6f,%.9f,%.9f,%.9f,%.9f\n", pose.stamp_ns, p.x(), p.y(),
              p.z(), q.w(), q.x(), q.y(), q.z());
  }
  out.finish();
}

std::vector<PathPose> true_poses(const SimulatedWalk& walk, double rate_hz) {
  std::vector<PathPose> poses;
  const auto count = static_cast<std::int64_t>(walk.options.duration_s * rate_hz);
  for (std::int64_t k = 0; k <= count; ++k) {
    const TimestampNs stamp = walk.options.start_ns + to_ns(static_cast<double>(k) / rate_hz);
    const MotionState state = walk.state_at(stamp);
    poses.push_back({stamp, state.position_m, state.world_from_body});
  }
  return poses;
}

void write_steps(const std::vector<TrueStep>& steps, const fs::path& file) {
  TextOutput out(file);
  out.print("#timestamp [ns],length [m]\n");
  for (const TrueStep& step : steps) out.print("%" PRId64 ",%.4f\n", step.stamp_ns, step.length_m);
  out.finish();
}

void write_calibration(const Camera& c, double rate_hz, const fs::path& file) {
  const Eigen::Matrix4d t = c.body_from_camera.matrix();
  TextOutput out(file);
  out.print("# Camera of a simulated walk, in EuRoC's form.\nsensor_type: camera\n");
  out.print("comment: simulated pinhole camera\n\n");
  out.print("# Body (forward, left, up) from camera (right, down, forward).\nT_BS:\n");
  out.print("  cols: 4\n  rows: 4\n  data: [");
  for (int row = 0; row < 4; ++row) {
    out.print("%.12g, %.12g, %.12g, %.12g%s", t(row, 0), t(row, 1), t(row, 2), t(row, 3),
              row < 3 ? ",\n         " : "]\n\n");
  }
  out.print("rate_hz: %g\nresolution: [%d, %d]\n", rate_hz, c.width, c.height);
  out.print("camera_model: pinhole\nintrinsics: [%.9g, %.9g, %.9g, %.9g] #fu, fv, cu, cv\n", c.fx,
            c.fy, c.cx, c.cy);
  const auto& k = c.distortion;
  const bool is_fisheye = c.lens == Lens::kEquidistant;
  out.print("distortion_model: %s\n", is_fisheye ? "equidistant" : "radial-tangential");
  out.print("distortion_coefficients: [%.9g, %.9g, %.9g, %.9g", k[0], k[1], k[2], k[3]);
  if (!is_fisheye && k[4] != 0.0) out.print(", %.9g", k[4]);
  out.print("]\n");
  out.finish();
}

void write_image(const cv::Mat& image, const fs::path& file, int jpeg_quality) {
  std::vector<unsigned char> bytes;
  const std::string kind = file.extension().string();
  if (!cv::imencode(kind, image, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality})) {
    cannot_write(file, "the picture does not encode");
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) cannot_write(file, std::strerror(errno));
}

/// Millimetres in 16 bits, as depth cameras have it; 0 where it is farther than they hold.
cv::Mat in_millimetres(const cv::Mat& depth_m) {
  cv::Mat image(depth_m.size(), CV_16UC1);
  for (int row = 0; row < depth_m.rows; ++row) {
    for (int column = 0; column < depth_m.cols; ++column) {
      const float mm = 1e3F * depth_m.at<float>(row, column) + 0.5F;
      image.at<std::uint16_t>(row, column) =
          mm < 65536.0F ? static_cast<std::uint16_t>(mm) : std::uint16_t{0};
    }
  }
  return image;
}

void write_images(const Film& film, double rate_hz, const fs::path& folder,
                  const RecordingOptions& options, const Progress& progress) {
  make_folder(folder / "cam0" / "data");
  if (options.depth) make_folder(folder / "depth0" / "data");
  write_calibration(film.shot().camera, rate_hz, folder / "cam0" / "sensor.yaml");
  TextOutput table(folder / "cam0" / "data.csv");
  table.print("#timestamp [ns],filename\n");
  for (std::size_t k = 0; k < film.count(); ++k) {
    const std::string name = std::to_string(film.stamp(k));
    write_image(film.image(k), folder / "cam0" / "data" / (name + ".jpg"), options.jpeg_quality);
    if (options.depth) {
      write_image(in_millimetres(film.depth(k)), folder / "depth0" / "data" / (name + ".png"), 0);
    }
    table.print("%s,%s.jpg\n", name.c_str(), name.c_str());
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(film.count()));
  }
  table.finish();
}

}  // namespace

void write_recording(const SimulatedWalk& walk, const fs::path& folder,
                     const RecordingOptions& options, const Progress& progress) {
  if (!(options.truth_rate_hz > 0.0)) {
    throw ConfigurationFault("simulate: truth_rate_hz must be above 0");
  }
  prepare(folder);
  // First, so that an interrupted recording is known as one that may be written anew.
  write_about(walk, options, folder / "about.yaml");
  write_imu(walk.imu, folder / "imu0");
  write_mag(walk.mag, folder / "mag0");
  write_pressure(walk.pressure, folder / "baro0");
  write_truth(true_poses(walk, options.truth_rate_hz), folder / "groundtruth.csv");
  write_steps(walk.steps, folder / "steps.csv");
  if (options.images && !walk.frames.empty()) {
    const Film film(shot_of(std::make_shared<const SimulatedWalk>(walk)), options.film);
    write_images(film, walk.options.camera_rate_hz, folder, options, progress);
  }
  if (progress) progress(1.0);
}

void write_recording(const PathWalk& walk, const fs::path& folder, const RecordingOptions& options,
                     const Progress& progress) {
  prepare(folder);
  write_about(walk, options, folder / "about.yaml");
  write_imu(walk.imu, folder / "imu0");
  write_mag(walk.mag, folder / "mag0");
  write_pressure(walk.pressure, folder / "baro0");
  write_truth(walk.path.poses(), folder / "groundtruth.csv");
  if (options.images && !walk.shot.frames.empty()) {
    write_images(Film(walk.shot, options.film), walk.camera_rate_hz, folder, options, progress);
  }
  if (progress) progress(1.0);
}

}  // namespace vpdr::simulation
