// How well the vanishing-point heading does on real images, and how long it takes:
//   bench_vision_accuracy [DATA] [--csv FILE]
// DATA (default $VPDR_DATA, then ../shared/data) is the folder of recordings, unpacked.
//   york_urban_vp         51 buildings with true vanishing directions
//   corridor_rgbd_lpvo    a walk along corridors with 90 degree turns, no truth but the corridors
//   euroc_mh01            a shaken camera in a machine hall, with true attitude
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/rotation.hpp"
#include "vision/core/vanishing_point_heading.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;          // NOLINT: a program, not a header
using namespace vpdr::vision;  // NOLINT

constexpr double kQuarter = 0.5 * kPi;

double quantile(std::vector<double> v, double share) {
  if (v.empty()) return std::nan("");
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(share * static_cast<double>(v.size())))];
}

double rms(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, v.size())));
}

double quarter_wrapped(double a) { return a - kQuarter * std::round(a / kQuarter); }

std::vector<double> numbers(const std::string& line) {
  std::vector<double> out;
  std::stringstream s(line);
  for (std::string cell; std::getline(s, cell, ',');) out.push_back(std::atof(cell.c_str()));
  return out;
}

// Processor time: what one core would need, whatever else it does.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

struct Timed {
  std::vector<double> ms;
  VisionOutput operator()(VanishingPointHeading& vision, const cv::Mat& image, TimestampNs stamp,
                          const std::optional<AttitudePrior>& prior) {
    const double start = cpu_ms();
    VisionOutput out = vision.process(image, stamp, prior);
    ms.push_back(cpu_ms() - start);
    return out;
  }
  void print(const char* what) const {
    std::printf("  %-28s p50 %.1f ms, p95 %.1f ms, max %.1f ms of one core a frame\n", what,
                quantile(ms, 0.5), quantile(ms, 0.95), quantile(ms, 1.0));
  }
};

// Attitude whose up, in camera axes, is `up`; yaw arbitrary.
AttitudePrior attitude_with_up(const CameraModel& camera, const Eigen::Vector3d& up,
                               double sigma_rad) {
  const Eigen::Vector3d up_body = camera.parameters().body_from_camera * up;
  AttitudePrior prior;
  prior.world_from_body = Eigen::Quaterniond::FromTwoVectors(up_body, Eigen::Vector3d::UnitZ());
  prior.inclination_sigma_rad = sigma_rad;
  return prior;
}

// ------------------------------------------------------------------------------- York Urban

using Triplets = std::map<std::string, Eigen::Matrix3d>;

Triplets read_triplets(const fs::path& file) {
  Triplets out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::string name = line.substr(0, line.find(','));
    const std::vector<double> v = numbers(line);
    if (line[0] == '#' || v.size() < 5 || v[1] > 2.0) continue;
    out[name].col(static_cast<int>(v[1])) = Eigen::Vector3d(v[2], v[3], v[4]).normalized();
  }
  return out;
}

// Truth in our naming: up, and the two horizontals.
Eigen::Matrix3d corridor_of(const Eigen::Matrix3d& triplet) {
  int vertical = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(triplet(1, i)) > std::abs(triplet(1, vertical))) vertical = i;
  }
  Eigen::Vector3d up = triplet.col(vertical);
  if (up.y() > 0.0) up = -up;
  Eigen::Vector3d forward = triplet.col((vertical + 1) % 3);
  forward = (forward - forward.dot(up) * up).normalized();
  Eigen::Matrix3d r;
  r << forward, up.cross(forward), up;
  return r;
}

void york(const fs::path& folder, bool with_prior, std::ofstream* csv) {
  CameraParameters p;
  p.fx_px = p.fy_px = 674.917;
  p.cx_px = 307.551;
  p.cy_px = 251.454;
  const CameraModel camera(p);
  std::vector<double> heading_error;
  std::vector<double> direction_error;
  std::vector<double> normalised;
  Timed timed;
  int images = 0;
  for (const auto& [name, triplet] : read_triplets(folder / "gt_vanishing_directions.csv")) {
    const cv::Mat image = cv::imread(folder / "images" / (name + ".jpg"));
    if (image.empty()) continue;
    ++images;
    VanishingPointHeading vision({}, camera);
    const Eigen::Matrix3d truth = corridor_of(triplet);
    std::optional<AttitudePrior> prior;
    if (with_prior) {
      // An attitude filter's error: one degree, in a direction that changes with the image.
      const Eigen::Vector3d tilt(std::cos(images), 0.0, std::sin(images));
      prior = attitude_with_up(camera, exp_rotation(to_radians(1.0) * tilt) * truth.col(2), 0.03);
    }
    const VisionOutput out = timed(vision, image, images, prior);
    const double error =
        out.frame ? quarter_wrapped(level_view_angles(out.frame->camera_from_corridor).heading_rad -
                                    level_view_angles(truth).heading_rad)
                  : kPi;
    if (csv != nullptr && out.frame) {
      const ManhattanFrame& f = *out.frame;
      *csv << name << ',' << with_prior << ',' << name_of(out.outcome) << ',' << to_degrees(error)
           << ',' << to_degrees(out.heading.sigma_rad) << ',' << f.inliers[0] + f.inliers[1] << ','
           << f.support[0] + f.support[1] << ',' << f.support[2] << ',' << f.unexplained << ','
           << f.contrast << '\n';
    }
    if (out.outcome != FrameOutcome::kFound) continue;
    heading_error.push_back(to_degrees(std::abs(error)));
    normalised.push_back(error / out.heading.sigma_rad);
    for (int i = 0; i < 3; ++i) {
      const double best =
          (out.frame->camera_from_corridor.transpose() * triplet.col(i)).cwiseAbs().maxCoeff();
      direction_error.push_back(to_degrees(std::acos(std::min(1.0, best))));
    }
  }
  std::printf("york_urban_vp, %s: found in %zu of %d images\n",
              with_prior ? "vertical known to 1 deg" : "nothing known", heading_error.size(),
              images);
  std::printf("  heading error deg: median %.2f, p90 %.2f, max %.2f\n",
              quantile(heading_error, 0.5), quantile(heading_error, 0.9),
              quantile(heading_error, 1.0));
  std::printf("  direction error deg: median %.2f, p90 %.2f, within 5 deg %.0f %%\n",
              quantile(direction_error, 0.5), quantile(direction_error, 0.9),
              100.0 *
                  static_cast<double>(std::count_if(direction_error.begin(), direction_error.end(),
                                                    [](double e) { return e < 5.0; })) /
                  static_cast<double>(std::max<std::size_t>(1, direction_error.size())));
  std::printf("  heading error over its sigma: RMS %.2f, median %.2f\n", rms(normalised),
              quantile(
                  [&] {
                    auto n = normalised;
                    for (double& x : n) x = std::abs(x);
                    return n;
                  }(),
                  0.5));
  timed.print("LSD, search, refinement");
}

// ------------------------------------------------------------------------------- LPVO corridor

void corridor(const fs::path& folder, std::ofstream* csv) {
  CameraParameters p;
  p.fx_px = 537.59990753;
  p.fy_px = 539.03332443;
  p.cx_px = 316.14867396;
  p.cy_px = 245.51866763;
  p.distortion = Distortion::kRadialTangential;
  p.coefficients = {0.03542659, -0.04764800, 0.00107085, 0.00126616, -0.20704202};
  VanishingPointHeading vision({}, CameraModel(p));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "rgb")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Timed timed;
  std::vector<double> sigmas;
  std::vector<double> straight;
  std::vector<double> jumps;
  std::optional<double> last;
  TimestampNs stamp = 0;
  for (const fs::path& file : files) {
    stamp += kNsPerSecond / 10;
    const VisionOutput out = timed(vision, cv::imread(file), stamp, std::nullopt);
    if (csv != nullptr && out.frame) {
      const ManhattanFrame& f = *out.frame;
      *csv << file.stem().string() << ",corridor," << name_of(out.outcome) << ','
           << to_degrees(out.heading.heading_rad) << ',' << to_degrees(out.heading.sigma_rad) << ','
           << f.inliers[0] + f.inliers[1] << ',' << f.support[0] + f.support[1] << ','
           << f.support[2] << ',' << f.unexplained << ',' << f.contrast << ','
           << to_degrees(out.heading.pitch_rad) << '\n';
    }
    if (!out.heading.found) continue;
    const double heading = out.heading.heading_rad;
    sigmas.push_back(to_degrees(out.heading.sigma_rad));
    if (last) jumps.push_back(to_degrees(std::abs(heading - *last)));
    if (std::abs(quarter_wrapped(heading)) < to_radians(20.0)) {
      straight.push_back(to_degrees(quarter_wrapped(heading)));
    }
    last = heading;
  }
  std::printf("corridor_rgbd_lpvo, nothing known: found in %llu of %zu frames\n",
              static_cast<unsigned long long>(vision.count(FrameOutcome::kFound)), files.size());
  std::printf(
      "  last heading %.1f deg; change between frames: median %.2f, max %.2f deg; "
      "sigma median %.2f deg; straights' RMS %.2f deg\n",
      to_degrees(last.value_or(0.0)), quantile(jumps, 0.5), quantile(jumps, 1.0),
      quantile(sigmas, 0.5), rms(straight));
  timed.print("LSD, search, refinement");
}

// ------------------------------------------------------------------------------- EuRoC

struct Pose {
  double t;
  Eigen::Quaterniond q;
};

std::vector<Pose> read_tum(const fs::path& file) {
  std::vector<Pose> out;
  std::ifstream in(file);
  double t = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
  for (std::string line; std::getline(in, line);) {
    std::stringstream s(line);
    if (s >> t >> x >> y >> z >> qx >> qy >> qz >> qw) out.push_back({t, {qw, qx, qy, qz}});
  }
  return out;
}

std::optional<Eigen::Quaterniond> attitude_at(const std::vector<Pose>& poses, double t) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), t,
                                      [](const Pose& p, double at) { return p.t < at; });
  if (after == poses.begin() || after == poses.end()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->t - before->t > 0.05) return std::nullopt;
  return before->q.slerp((t - before->t) / (after->t - before->t), after->q);
}

void euroc(const fs::path& folder, bool with_prior, std::ofstream* csv) {
  CameraParameters p;
  p.width_px = 752;
  p.height_px = 480;
  p.fx_px = 458.654;
  p.fy_px = 457.296;
  p.cx_px = 367.215;
  p.cy_px = 248.375;
  p.distortion = Distortion::kRadialTangential;
  p.coefficients = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0};
  p.body_from_camera << 0.0148655429818, -0.999880929698, 0.00414029679422, 0.999557249008,
      0.0149672133247, 0.025715529948, -0.0257744366974, 0.00375618835797, 0.999660727178;
  VanishingPointHeading vision({}, CameraModel(p));
  const std::vector<Pose> poses = read_tum(folder / "gt/groundtruth_tum.txt");
  Timed timed;
  std::vector<double> differences;
  std::vector<double> sigmas;
  std::vector<double> rate_errors;
  std::vector<double> rate_normalised;
  int frames = 0;
  double turned = 0.0;
  double last_yaw = 0.0;
  std::ifstream list(folder / "mav0/cam0/data.csv");
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    const TimestampNs stamp = std::atoll(line.c_str());
    std::string name = line.substr(line.find(',') + 1);
    name.erase(name.find_last_not_of(" \r\n") + 1);
    const cv::Mat image = cv::imread(folder / "mav0/cam0/data" / name, cv::IMREAD_GRAYSCALE);
    const auto truth = attitude_at(poses, to_seconds(stamp));
    if (image.empty() || !truth) continue;
    ++frames;
    const Eigen::Vector3d axis = *truth * p.body_from_camera.col(2);
    const double yaw = std::atan2(axis.y(), axis.x());
    std::optional<AttitudePrior> prior;
    if (with_prior) {
      // One degree of tilt and yaw that drifts at 1 deg/s.
      const Eigen::Vector3d tilt(to_radians(1.0), 0.0, to_radians(0.05 * frames));
      turned += wrap_pi(yaw - last_yaw);
      last_yaw = yaw;
      prior = AttitudePrior{exp_rotation(tilt) * *truth, 0.03,
                            GyroTurn{turned + to_radians(0.05 * frames), 0}};
    }
    const VisionOutput out = timed(vision, image, stamp, prior);
    if (csv != nullptr && out.frame) {
      const ManhattanFrame& f = *out.frame;
      *csv << stamp << ",euroc" << with_prior << ',' << name_of(out.outcome) << ','
           << to_degrees(out.heading.heading_rad) << ',' << to_degrees(out.heading.sigma_rad) << ','
           << f.inliers[0] + f.inliers[1] << ',' << f.support[0] + f.support[1] << ','
           << f.support[2] << ',' << f.unexplained << ',' << f.contrast << ',' << to_degrees(yaw)
           << '\n';
    }
    if (!out.heading.found) continue;
    differences.push_back(out.heading.heading_rad - yaw);
    sigmas.push_back(out.heading.sigma_rad);
    if (out.rate) {
      const auto q0 = attitude_at(poses, to_seconds(out.rate->interval_start_ns));
      const Eigen::Vector3d axis0 = *q0 * p.body_from_camera.col(2);
      const double truth_rate = wrap_pi(yaw - std::atan2(axis0.y(), axis0.x())) /
                                to_seconds(stamp - out.rate->interval_start_ns);
      rate_errors.push_back(to_degrees(out.rate->rate_radps - truth_rate));
      rate_normalised.push_back((out.rate->rate_radps - truth_rate) / out.rate->sigma_radps);
    }
  }
  const double offset = differences.empty() ? 0.0 : quantile(differences, 0.5);
  std::vector<double> errors;
  std::vector<double> normalised;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    errors.push_back(to_degrees(std::abs(wrap_pi(differences[i] - offset))));
    normalised.push_back(wrap_pi(differences[i] - offset) / sigmas[i]);
  }
  std::printf("euroc_mh01, %s: found in %zu of %d frames\n",
              with_prior ? "attitude known to 1 deg" : "nothing known", errors.size(), frames);
  std::printf(
      "  heading error deg (against true yaw, constant removed): median %.2f, p90 %.2f, "
      "max %.2f; over its sigma: RMS %.2f\n",
      quantile(errors, 0.5), quantile(errors, 0.9), quantile(errors, 1.0), rms(normalised));
  std::printf("  heading rate error deg/s: RMS %.2f over %zu; over its sigma: RMS %.2f\n",
              rms(rate_errors), rate_errors.size(), rms(rate_normalised));
  timed.print("LSD, search, refinement");
}

}  // namespace

int main(int argc, char** argv) {
  fs::path data = std::getenv("VPDR_DATA") != nullptr ? std::getenv("VPDR_DATA") : "../shared/data";
  std::ofstream csv;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--csv" && i + 1 < argc) {
      csv.open(argv[++i]);
    } else {
      data = argv[i];
    }
  }
  std::ofstream* out = csv.is_open() ? &csv : nullptr;
  cv::setNumThreads(1);
  const fs::path vision = data / "vision";
  if (!fs::exists(vision)) {
    std::printf("skipped: no data in %s\n", vision.c_str());
    return 0;
  }
  york(vision / "york_urban_vp", false, out);
  york(vision / "york_urban_vp", true, out);
  corridor(vision / "corridor_rgbd_lpvo", out);
  euroc(vision / "euroc_mh01", false, out);
  euroc(vision / "euroc_mh01", true, out);
  return 0;
}
