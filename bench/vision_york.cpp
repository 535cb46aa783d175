#include "bench/vision_york.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bench/vision_figures.hpp"
#include "vision/core/heading/building_directions.hpp"

namespace vpdr::bench {
namespace {

namespace fs = std::filesystem;
using namespace vision;  // NOLINT: a program, not a library

using Triplets = std::map<std::string, Eigen::Matrix3d>;

Triplets read_triplets(const fs::path& file) {
  Triplets out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::vector<double> v;
    std::stringstream s(line);
    for (std::string cell; std::getline(s, cell, ',');) v.push_back(std::atof(cell.c_str()));
    if (line[0] == '#' || v.size() < 5 || v[1] > 2.0) continue;
    out[line.substr(0, line.find(','))].col(static_cast<int>(v[1])) =
        Eigen::Vector3d(v[2], v[3], v[4]).normalized();
  }
  return out;
}

CameraModel york_camera() {
  CameraParameters p;
  p.fx_px = p.fy_px = 674.917;
  p.cx_px = 307.551;
  p.cy_px = 251.454;
  return CameraModel(p);
}

Eigen::Vector3d up_of(const Eigen::Matrix3d& triplet) {
  int vertical = 0;
  triplet.row(1).cwiseAbs().maxCoeff(&vertical);
  const Eigen::Vector3d up = triplet.col(vertical);
  return up.y() > 0.0 ? (-up).eval() : up;
}

// One degree off, to a side that changes with the image.
VerticalPrior one_degree_off(const Eigen::Vector3d& up, int image) {
  const Eigen::Vector3d side = up.unitOrthogonal();
  const double golden = 2.4 * image;
  const Eigen::Vector3d axis = std::cos(golden) * side + std::sin(golden) * up.cross(side);
  return {exp_rotation(to_radians(1.0) * axis) * up, to_radians(1.0)};
}

double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return to_degrees(std::acos(std::min(1.0, std::abs(a.dot(b)))));
}

// Angles to the true directions, in the order of what was found; the best of all ways to pair.
std::array<double, 3> errors_of(const std::array<Eigen::Vector3d, 3>& found,
                                const Eigen::Matrix3d& truth) {
  std::array<double, 3> best{180.0, 180.0, 180.0};
  std::array<int, 3> pair{0, 1, 2};
  const auto sum = [](const std::array<double, 3>& e) { return e[0] + e[1] + e[2]; };
  do {
    std::array<double, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) e[i] = angle_between_deg(found[i], truth.col(pair[i]));
    if (sum(e) < sum(best)) best = e;
  } while (std::next_permutation(pair.begin(), pair.end()));
  return best;
}

struct Tally {
  std::vector<double> each, mean, worst, normalised, ms, lsd_ms;

  void add(const std::array<double, 3>& e, const std::array<double, 3>& sigma) {
    mean.push_back((e[0] + e[1] + e[2]) / 3.0);
    worst.push_back(*std::max_element(e.begin(), e.end()));
    for (std::size_t i = 0; i < 3; ++i) {
      each.push_back(e[i]);
      normalised.push_back(to_radians(e[i]) / sigma[i]);
    }
  }

  [[nodiscard]] double share_within(double deg) const {
    const auto n = std::count_if(worst.begin(), worst.end(), [=](double e) { return e <= deg; });
    return 100.0 * static_cast<double>(n) /
           static_cast<double>(std::max<std::size_t>(1, ms.size()));
  }

  void print(bool vertical_known) const {
    std::printf("york_urban_vp, %s: found in %zu of %zu images\n",
                vertical_known ? "vertical known to 1 deg" : "nothing known", mean.size(),
                ms.size());
    std::printf(
        "  error deg of the three directions: each median %.2f p90 %.2f; mean of three, median "
        "%.2f p90 %.2f; worst of three, median %.2f p90 %.2f max %.2f, within 5 deg %.0f %% of "
        "images; over sigma: RMS %.2f\n",
        quantile(each, 0.5), quantile(each, 0.9), quantile(mean, 0.5), quantile(mean, 0.9),
        quantile(worst, 0.5), quantile(worst, 0.9), quantile(worst, 1.0), share_within(5.0),
        rms(normalised));
    std::printf(
        "  p50 %.1f ms, p95 %.1f ms of one core an image; OpenCV's LSD alone %.1f ms: ratio %.2f\n",
        quantile(ms, 0.5), quantile(ms, 0.95), quantile(lsd_ms, 0.5),
        quantile(ms, 0.5) / quantile(lsd_ms, 0.5));
  }
};

double lsd_ms(const cv::Mat& grey) {
  const auto lsd = cv::createLineSegmentDetector();
  std::vector<cv::Vec4f> segments;
  const double start = cpu_ms();
  lsd->detect(grey, segments);
  return cpu_ms() - start;
}

}  // namespace

void york(const fs::path& folder, bool vertical_known, std::ofstream* csv) {
  BuildingDirections directions({}, york_camera());
  Tally tally;
  int images = 0;
  for (const auto& [name, truth] : read_triplets(folder / "gt_vanishing_directions.csv")) {
    const cv::Mat grey = cv::imread(folder / "images" / (name + ".jpg"), cv::IMREAD_GRAYSCALE);
    if (grey.empty()) continue;
    ++images;
    std::optional<VerticalPrior> vertical;
    if (vertical_known) vertical = one_degree_off(up_of(truth), images);
    const double start = cpu_ms();
    const DirectionsSeen seen = directions.look(grey, vertical);
    tally.ms.push_back(cpu_ms() - start);
    tally.lsd_ms.push_back(lsd_ms(grey));
    if (seen.outcome != FrameOutcome::kFound) continue;
    const std::array<double, 3> e = errors_of(seen.directions, truth);
    tally.add(e, seen.sigma_rad);
    if (csv != nullptr) {
      *csv << "york" << vertical_known << ',' << name << ',' << e[0] << ',' << e[1] << ',' << e[2]
           << '\n';
    }
  }
  tally.print(vertical_known);
}

}  // namespace vpdr::bench
