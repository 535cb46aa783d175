// How well the vanishing-point heading does on real images, and how long it takes:
//   bench_vision_accuracy [DATA] [--csv FILE] [--only SET]
//   york_urban_vp         51 buildings with true vanishing directions
//   corridor_rgbd_lpvo    a walk along corridors with 90 degree turns, no truth but the corridors
//   euroc_mh01            a shaken camera in a machine hall, with true attitude
//   simulated             a walk through rendered corridors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bench/sets.hpp"
#include "bench/true_motion.hpp"
#include "bench/vision_figures.hpp"
#include "bench/vision_york.hpp"
#include "core/rotation.hpp"
#include "simulation/walk_camera.hpp"
#include "vision/core/heading/vanishing_point_heading.hpp"
#include "vision/source/simulated_source.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;          // NOLINT: a program, not a header
using namespace vpdr::vision;  // NOLINT
using namespace vpdr::bench;   // NOLINT

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
  std::vector<double> headings;
  TimestampNs stamp = 0;
  for (const fs::path& file : files) {
    stamp += kNsPerSecond / 10;
    const VisionOutput out = timed(vision, cv::imread(file), stamp, std::nullopt);
    write_row(csv, "corridor", std::atoll(file.stem().c_str()), out, 0.0);
    if (!out.heading.found) continue;
    sigmas.push_back(to_degrees(out.heading.sigma_rad));
    headings.push_back(to_degrees(out.heading.heading_rad));
  }
  std::printf(
      "corridor_rgbd_lpvo, nothing known: found in %zu of %zu frames, last heading %.1f deg, "
      "sigma median %.2f deg\n",
      headings.size(), files.size(), headings.empty() ? 0.0 : headings.back(),
      quantile(sigmas, 0.5));
  print_straights(headings);
  timed.print();
}

// ------------------------------------------------------------------------------- EuRoC

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
  const std::vector<dataset::TruthPose> poses = read_tum(folder / "gt/groundtruth_tum.txt");
  Timed timed;
  std::vector<double> differences;
  std::vector<double> sigmas;
  Errors rate;
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
    const auto truth = pose_at(poses, stamp);
    if (image.empty() || !truth) continue;
    ++frames;
    const Eigen::Vector3d axis = truth->linear() * p.body_from_camera.col(2);
    const double yaw = std::atan2(axis.y(), axis.x());
    std::optional<AttitudePrior> prior;
    turned += wrap_pi(yaw - last_yaw);
    last_yaw = yaw;
    if (with_prior) {
      prior =
          disturbed(Eigen::Quaterniond(truth->linear()), turned, static_cast<std::size_t>(frames));
    }
    const VisionOutput out = timed(vision, image, stamp, prior);
    write_row(csv, "euroc" + std::to_string(with_prior), stamp, out, yaw);
    if (!out.heading.found) continue;
    differences.push_back(out.heading.heading_rad - yaw);
    sigmas.push_back(out.heading.sigma_rad);
    if (out.rate) {
      const auto before = pose_at(poses, out.rate->interval_start_ns);
      const Eigen::Vector3d axis0 = before->linear() * p.body_from_camera.col(2);
      const double truth_rate = wrap_pi(yaw - std::atan2(axis0.y(), axis0.x())) /
                                to_seconds(stamp - out.rate->interval_start_ns);
      rate.add(out.rate->rate_radps - truth_rate, out.rate->sigma_radps);
    }
  }
  const double offset = differences.empty() ? 0.0 : quantile(differences, 0.5);
  Errors heading;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    heading.add(wrap_pi(differences[i] - offset), sigmas[i]);
  }
  std::printf("euroc_mh01, %s: found in %zu of %d frames\n",
              with_prior ? "attitude known to 1 deg" : "nothing known", heading.deg.size(), frames);
  heading.print("heading error deg, against true yaw, constant removed");
  rate.print("heading rate error deg/s");
  timed.print();
}

// ------------------------------------------------------------------------------- simulation

// A simulated walk through corridors with turns: the building's directions are east and north.
void simulated(bool with_prior, std::ofstream* csv) {
  simulation::WalkOptions options;
  options.duration_s = 90.0;
  const simulation::WalkCamera pictures(simulation::simulate_walk(options));
  const CameraModel camera = make_camera(options.camera);
  VanishingPointHeading vision({}, camera);
  Timed timed;
  Errors heading;
  Errors rate;
  double turned = 0.0;
  double last_yaw = 0.0;
  std::optional<double> anchor;
  for (std::size_t k = 0; k < pictures.count(); ++k) {
    const TimestampNs stamp = pictures.stamp(k);
    const Eigen::Matrix3d world_from_camera = pictures.walk().world_from_camera(stamp).linear();
    const double yaw = std::atan2(world_from_camera(1, 2), world_from_camera(0, 2));
    turned += wrap_pi(yaw - last_yaw);
    last_yaw = yaw;
    const Eigen::Matrix3d world_from_body =
        world_from_camera * camera.parameters().body_from_camera.transpose();
    std::optional<AttitudePrior> prior;
    if (with_prior) prior = disturbed(Eigen::Quaterniond(world_from_body), turned, k);
    const VisionOutput out = timed(vision, pictures.image(k), stamp, prior);
    write_row(csv, "simulated" + std::to_string(with_prior), stamp, out, turned);
    if (!out.heading.found) continue;
    // The first corridor runs along the axis nearest to the first heading.
    if (!anchor) anchor = kQuarter * std::round((turned - out.heading.heading_rad) / kQuarter);
    heading.add(out.heading.heading_rad - (turned - *anchor), out.heading.sigma_rad);
    if (!out.rate) continue;
    const Eigen::Vector3d axis0 =
        pictures.walk().world_from_camera(out.rate->interval_start_ns).linear().col(2);
    const double true_rate = wrap_pi(yaw - std::atan2(axis0.y(), axis0.x())) /
                             to_seconds(stamp - out.rate->interval_start_ns);
    rate.add(out.rate->rate_radps - true_rate, out.rate->sigma_radps);
  }
  std::printf("simulated walk, %s: found in %zu of %zu frames; last heading %.1f deg\n",
              with_prior ? "attitude known to 1 deg" : "nothing known", heading.deg.size(),
              pictures.count(), to_degrees(turned - anchor.value_or(0.0)));
  heading.print("heading error deg");
  rate.print("heading rate error deg/s");
  timed.print();
}

}  // namespace

int main(int argc, char** argv) {
  return run_sets(argc, argv,
                  {{"york_urban_vp", "vision/york_urban_vp",
                    [](const fs::path& folder, std::ofstream* csv) {
                      york(folder, false, csv);
                      york(folder, true, csv);
                    }},
                   {"corridor_rgbd_lpvo", "vision/corridor_rgbd_lpvo", corridor},
                   {"euroc_mh01", "vision/euroc_mh01",
                    [](const fs::path& folder, std::ofstream* csv) {
                      euroc(folder, false, csv);
                      euroc(folder, true, csv);
                    }},
                   {"simulated", "", [](const fs::path&, std::ofstream* csv) {
                      simulated(false, csv);
                      simulated(true, csv);
                    }}});
}
