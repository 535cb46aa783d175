#include "bench/vision_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>

namespace vpdr::bench {

using namespace vision;  // NOLINT: a program, not a library

// Processor time: what one core would need, whatever else it does.
double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

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

void Errors::add(double error_rad, double sigma_rad) {
  deg.push_back(to_degrees(std::abs(error_rad)));
  normalised.push_back(std::abs(error_rad) / sigma_rad);
}

void Errors::print(const char* what) const {
  std::printf("  %s: median %.2f, p90 %.2f, max %.2f; over its sigma: RMS %.2f, median %.2f\n",
              what, quantile(deg, 0.5), quantile(deg, 0.9), quantile(deg, 1.0), rms(normalised),
              quantile(normalised, 0.5));
}

AttitudePrior disturbed(const Eigen::Quaterniond& truth, double turned_rad, std::size_t frame) {
  const double drift = to_radians(0.05) * static_cast<double>(frame);
  AttitudePrior prior;
  prior.world_from_body = exp_rotation({to_radians(1.0), 0.0, drift}) * truth;
  prior.inclination_sigma_rad = 0.03;
  prior.turn = GyroTurn{turned_rad + drift, 0};
  return prior;
}

void write_row(std::ofstream* csv, const std::string& set, TimestampNs stamp,
               const VisionOutput& out, double truth_rad) {
  if (csv == nullptr || !out.frame) return;
  const ManhattanFrame& f = *out.frame;
  *csv << set << ',' << stamp << ',' << name_of(out.outcome) << ','
       << to_degrees(out.heading.heading_rad) << ',' << to_degrees(out.heading.sigma_rad) << ','
       << f.inliers[0] + f.inliers[1] << ',' << f.support[0] + f.support[1] << ',' << f.support[2]
       << ',' << f.unexplained << ',' << f.contrast << ',' << to_degrees(out.heading.pitch_rad)
       << ',' << to_degrees(truth_rad) << '\n';
}

VisionOutput Timed::operator()(VanishingPointHeading& heading, const cv::Mat& image,
                               TimestampNs stamp, const std::optional<AttitudePrior>& prior) {
  const double start = cpu_ms();
  VisionOutput out = heading.process(image, stamp, prior);
  ms.push_back(cpu_ms() - start);
  return out;
}

void Timed::print() const {
  std::printf("  p50 %.1f ms, p95 %.1f ms, max %.1f ms of one core a frame\n", quantile(ms, 0.5),
              quantile(ms, 0.95), quantile(ms, 1.0));
}

void print_straights(const std::vector<double>& headings) {
  constexpr int kHalf = 7;
  std::vector<double> spread;
  std::map<int, std::vector<double>> along;  // multiples of 90 degrees -> headings there
  std::vector<double> jumps;
  for (std::size_t i = 1; i < headings.size(); ++i) {
    jumps.push_back(std::abs(headings[i] - headings[i - 1]));
  }
  for (std::size_t i = kHalf; i + kHalf < headings.size(); ++i) {
    double slope = 0.0;
    double mean = 0.0;
    double squares = 0.0;
    for (int k = -kHalf; k <= kHalf; ++k) {
      const double h = headings[i + static_cast<std::size_t>(k + kHalf) - kHalf];
      slope += k * h;
      mean += h / (2 * kHalf + 1);
      squares += k * k;
    }
    const int quarter = static_cast<int>(std::lround(mean / 90.0));
    if (std::abs(slope / squares) > 0.3 || std::abs(mean - 90.0 * quarter) > 10.0) continue;
    spread.push_back(headings[i] - mean);
    along[quarter].push_back(headings[i]);
  }
  std::printf(
      "  change between frames: median %.2f, max %.2f deg; straights: RMS about the local "
      "mean %.2f deg;",
      quantile(jumps, 0.5), quantile(jumps, 1.0), rms(spread));
  for (const auto& [quarter, values] : along) {
    std::printf(" corridor at %d deg: median %.1f over %zu frames;", 90 * quarter,
                quantile(values, 0.5), values.size());
  }
  if (along.size() > 1) {
    const double turn =
        quantile(along.rbegin()->second, 0.5) - quantile(along.begin()->second, 0.5);
    const int quarters = along.rbegin()->first - along.begin()->first;
    std::printf(" total turn %.1f deg, %.1f deg off;", turn, turn - 90.0 * quarters);
  }
  std::printf("\n");
}

}  // namespace vpdr::bench
