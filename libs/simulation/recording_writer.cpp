#include "simulation/recording_writer.hpp"

#include <cerrno>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "core/errors.hpp"
#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDataset = "dataset: \"vpdr simulated walk\"";

[[noreturn]] void cannot_write(const fs::path& file, const std::string& reason) {
  throw FileFault(file.string() + ": cannot be written: " + reason +
                  "; free some space or choose another folder");
}

/// A text file whose failure to reach the disk is a fault.
class TextFile {
 public:
  explicit TextFile(const fs::path& file) : path_(file), file_(std::fopen(file.c_str(), "wb")) {
    if (file_ == nullptr) cannot_write(path_, std::strerror(errno));
  }
  ~TextFile() {
    if (file_ != nullptr) std::fclose(file_);
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  [[gnu::format(printf, 2, 3)]] void print(const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): clang 14 overlooks va_start above
    const int written = std::vfprintf(file_, format, arguments);
    va_end(arguments);
    if (written < 0) cannot_write(path_, std::strerror(errno));
  }

  void finish() {
    std::FILE* file = std::exchange(file_, nullptr);
    if (std::fclose(file) != 0) cannot_write(path_, std::strerror(errno));
  }

 private:
  fs::path path_;
  std::FILE* file_;
};

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
    for (const char* part : {"imu0", "mag0", "baro0", "cam0", "groundtruth.csv", "steps.csv"}) {
      fs::remove_all(folder / part, error);
      if (error) cannot_write(folder / part, error.message());
    }
  }
  make_folder(folder);
}

void write_about(const SimulatedWalk& walk, const RecordingOptions& options, const fs::path& file) {
  const WalkOptions& o = walk.options;
  TextFile out(file);
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

void write_imu(const SimulatedWalk& walk, const fs::path& folder) {
  make_folder(folder);
  TextFile out(folder / "data.csv");
  out.print(
      "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z "
      "[m/s^2]\n");
  for (const ImuSample& s : walk.imu) {
    const auto &w = s.angular_velocity_radps, &a = s.specific_force_mps2;
    out.print("%" PRId64 ",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", s.stamp_ns, w.x(), w.y(), w.z(), a.x(),
              a.y(), a.z());
  }
  out.finish();
}

void write_mag(const SimulatedWalk& walk, const fs::path& folder) {
  if (walk.mag.empty()) return;
  make_folder(folder);
  TextFile out(folder / "data.csv");
  out.print("#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]\n");
  for (const MagSample& s : walk.mag) {
    out.print("%" PRId64 ",%.7g,%.7g,%.7g\n", s.stamp_ns, s.field_ut.x(), s.field_ut.y(),
              s.field_ut.z());
  }
  out.finish();
}

void write_pressure(const SimulatedWalk& walk, const fs::path& folder) {
  if (walk.pressure.empty()) return;
  make_folder(folder);
  TextFile out(folder / "data.csv");
  out.print("#timestamp [ns],pressure [Pa]\n");
  for (const PressureSample& s : walk.pressure) {
    out.print("%" PRId64 ",%.9g\n", s.stamp_ns, s.pressure_pa);
  }
  out.finish();
}

void write_truth(const SimulatedWalk& walk, const fs::path& folder, double rate_hz) {
  TextFile poses(folder / "groundtruth.csv");
  poses.print("#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n");
  const auto count = static_cast<std::int64_t>(walk.options.duration_s * rate_hz);
  for (std::int64_t k = 0; k <= count; ++k) {
    const TimestampNs stamp = walk.options.start_ns + to_ns(static_cast<double>(k) / rate_hz);
    const MotionState state = walk.state_at(stamp);
    const auto& p = state.position_m;
    const auto& q = state.world_from_body;
    poses.print("%" PRId64 ",%.6f,%.6f,%.6f,%.9f,%.9f,%.9f,%.9f\n", stamp, p.x(), p.y(), p.z(),
                q.w(), q.x(), q.y(), q.z());
  }
  poses.finish();
  TextFile steps(folder / "steps.csv");
  steps.print("#timestamp [ns],length [m]\n");
  for (const TrueStep& step : walk.steps) {
    steps.print("%" PRId64 ",%.4f\n", step.stamp_ns, step.length_m);
  }
  steps.finish();
}

void write_calibration(const SimulatedWalk& walk, const fs::path& file) {
  const Camera& c = walk.options.camera;
  const Eigen::Matrix4d t = c.body_from_camera.matrix();
  TextFile out(file);
  out.print("# Camera of a simulated walk, in EuRoC's form.\nsensor_type: camera\n");
  out.print("comment: simulated pinhole camera\n\n");
  out.print("# Body (forward, left, up) from camera (right, down, forward).\nT_BS:\n");
  out.print("  cols: 4\n  rows: 4\n  data: [");
  for (int row = 0; row < 4; ++row) {
    out.print("%.12g, %.12g, %.12g, %.12g%s", t(row, 0), t(row, 1), t(row, 2), t(row, 3),
              row < 3 ? ",\n         " : "]\n\n");
  }
  out.print("rate_hz: %g\nresolution: [%d, %d]\n", walk.options.camera_rate_hz, c.width, c.height);
  out.print("camera_model: pinhole\nintrinsics: [%.9g, %.9g, %.9g, %.9g] #fu, fv, cu, cv\n", c.fx,
            c.fy, c.cx, c.cy);
  out.print("distortion_model: radial-tangential\n");
  out.print("distortion_coefficients: [%.9g, %.9g, %.9g, %.9g]\n", c.distortion[0], c.distortion[1],
            c.distortion[2], c.distortion[3]);
  out.finish();
}

void write_image(const cv::Mat& image, const fs::path& file, int quality) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality})) {
    cannot_write(file, "the picture does not encode");
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) cannot_write(file, std::strerror(errno));
}

void write_images(const SimulatedWalk& walk, const fs::path& folder,
                  const RecordingOptions& options, const Progress& progress) {
  make_folder(folder / "data");
  write_calibration(walk, folder / "sensor.yaml");
  const CorridorRenderer renderer(walk.plan, walk.options.camera, walk.options.seed,
                                  options.render);
  TextFile table(folder / "data.csv");
  table.print("#timestamp [ns],filename\n");
  for (std::size_t k = 0; k < walk.frames.size(); ++k) {
    const TimestampNs stamp = walk.frames[k];
    const std::string name = std::to_string(stamp) + ".jpg";
    write_image(renderer.render(walk.world_from_camera(stamp), k), folder / "data" / name,
                options.jpeg_quality);
    table.print("%" PRId64 ",%s\n", stamp, name.c_str());
    if (progress) {
      progress(static_cast<double>(k + 1) / static_cast<double>(walk.frames.size()));
    }
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
  write_imu(walk, folder / "imu0");
  write_mag(walk, folder / "mag0");
  write_pressure(walk, folder / "baro0");
  write_truth(walk, folder, options.truth_rate_hz);
  if (options.images && !walk.frames.empty()) {
    write_images(walk, folder / "cam0", options, progress);
  }
  if (progress) progress(1.0);
}

}  // namespace vpdr::simulation
