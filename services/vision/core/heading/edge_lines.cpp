#include "vision/core/heading/edge_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

constexpr int kKernel = 5;
// What that kernel makes of a step of one grey level.
constexpr float kStepResponse = 48.0F;
constexpr int kMargin = kKernel / 2;
constexpr std::size_t kSeedBins = 1024;
constexpr float kStrongest = 256.0F * kStepResponse * 1.5F;
constexpr std::int32_t kNoEdge = -1;
constexpr double kLeastPoints = 5.0;

}  // namespace

void EdgeLines::Line::add(const Eigen::Vector2d& point) {
  const Eigen::Vector2d p = point - origin;
  count += 1.0;
  x += p.x();
  y += p.y();
  xx += p.x() * p.x();
  xy += p.x() * p.y();
  yy += p.y() * p.y();
}

// The greater principal axis through the mean, in the sense it had.
void EdgeLines::Line::fit() {
  const Eigen::Vector2d mean(x / count, y / count);
  through = origin + mean;
  const double sxy = xy / count - mean.x() * mean.y();
  const double half = 0.5 * (xx / count - mean.x() * mean.x() - yy / count + mean.y() * mean.y());
  const double root = std::hypot(half, sxy);
  const Eigen::Vector2d axis =
      half > 0.0 ? Eigen::Vector2d(half + root, sxy) : Eigen::Vector2d(sxy, root - half);
  const double norm = axis.norm();
  if (norm > 1e-12) direction = axis * ((axis.dot(direction) < 0.0 ? -1.0 : 1.0) / norm);
}

Eigen::Vector2d EdgeLines::Line::foot(const Eigen::Vector2d& point) const {
  return through + (point - through).dot(direction) * direction;
}

double EdgeLines::Line::distance(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d d = point - through;
  return std::abs(d.y() * direction.x() - d.x() * direction.y());
}

EdgeLines::EdgeLines(const EdgeLineConfig& config)
    : config_(config), min_alignment_(std::cos(config.angle_rad)) {}

const std::vector<LineSegment>& EdgeLines::detect(const cv::Mat& grey) {
  segments_.clear();
  measure_gradient(grey);
  find_edges();
  order_seeds();
  for (const std::size_t seed : seeds_) {
    if (edge_at_[edges_[seed].cell] != kNoEdge) grow(seed);
  }
  return segments_;
}

void EdgeLines::measure_gradient(const cv::Mat& grey) {
  width_ = grey.cols;
  height_ = grey.rows;
  cv::Sobel(grey, gradient_x_, CV_16S, 1, 0, kKernel);
  cv::Sobel(grey, gradient_y_, CV_16S, 0, 1, kKernel);
  gradient_.create(height_, width_, CV_32F);
  for (int row = 0; row < height_; ++row) {
    const std::int16_t* gx = gradient_x_.ptr<std::int16_t>(row);
    const std::int16_t* gy = gradient_y_.ptr<std::int16_t>(row);
    float* g = gradient_.ptr<float>(row);
    for (int column = 0; column < width_; ++column) {
      const auto x = static_cast<float>(gx[column]);
      const auto y = static_cast<float>(gy[column]);
      g[column] = std::sqrt(x * x + y * y);
    }
  }
}

// Local maxima of the gradient along the image axis that is nearer to it.
void EdgeLines::find_edges() {
  edge_at_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNoEdge);
  edges_.clear();
  const float threshold = static_cast<float>(config_.min_contrast) * kStepResponse;
  for (int row = kMargin; row < height_ - kMargin; ++row) {
    const std::int16_t* gx = gradient_x_.ptr<std::int16_t>(row);
    const std::int16_t* gy = gradient_y_.ptr<std::int16_t>(row);
    const float* above = gradient_.ptr<float>(row - 1);
    const float* here = gradient_.ptr<float>(row);
    const float* below = gradient_.ptr<float>(row + 1);
    for (int column = kMargin; column < width_ - kMargin; ++column) {
      if (here[column] < threshold) continue;
      const bool across_columns = std::abs(gx[column]) > std::abs(gy[column]);
      const float before = across_columns ? here[column - 1] : above[column];
      const float after = across_columns ? here[column + 1] : below[column];
      if (here[column] <= before || here[column] < after) continue;
      add_edge(row, column, before, here[column], after, across_columns);
    }
  }
}

void EdgeLines::add_edge(int row, int column, float before, float here, float after,
                         bool across_columns) {
  Edge e;
  e.at = {static_cast<float>(column), static_cast<float>(row)};
  const float offset = 0.5F * (before - after) / (before - 2.0F * here + after);
  e.at[across_columns ? 0 : 1] += offset;
  e.normal = {static_cast<float>(gradient_x_.at<std::int16_t>(row, column)) / here,
              static_cast<float>(gradient_y_.at<std::int16_t>(row, column)) / here};
  e.strength = here;
  e.cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  edge_at_[e.cell] = static_cast<std::int32_t>(edges_.size());
  edges_.push_back(e);
}

// A counting sort: strongest first, equal ones by their place.
void EdgeLines::order_seeds() {
  const float least = static_cast<float>(config_.seed_contrast) * kStepResponse;
  const auto bin = [](const Edge& e) {
    const float share = std::min(e.strength / kStrongest, 1.0F);
    return static_cast<std::size_t>((1.0F - share) * static_cast<float>(kSeedBins - 1));
  };
  bins_.assign(kSeedBins + 1, 0);
  for (const Edge& e : edges_) {
    if (e.strength >= least) ++bins_[bin(e) + 1];
  }
  for (std::size_t i = 1; i < bins_.size(); ++i) bins_[i] += bins_[i - 1];
  seeds_.resize(bins_.back());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].strength >= least) seeds_[bins_[bin(edges_[i])]++] = i;
  }
}

void EdgeLines::grow(std::size_t seed) {
  const Edge& first = edges_[seed];
  Line line;
  line.origin = line.through = first.at.cast<double>();
  line.direction = {first.normal.y(), -first.normal.x()};
  line.add(line.origin);
  edge_at_[first.cell] = kNoEdge;
  const std::size_t end = extend(seed, 1.0, line);
  const std::size_t start = extend(seed, -1.0, line);
  if (line.count < kLeastPoints) return;
  line.fit();
  segments_.push_back(
      {line.foot(edges_[start].at.cast<double>()), line.foot(edges_[end].at.cast<double>())});
}

// Takes points from `from` on along the line, or against it; the last one taken.
std::size_t EdgeLines::extend(std::size_t from, double sense, Line& line) {
  for (auto found = next(from, sense, line); found; found = next(from, sense, line)) {
    from = *found;
    edge_at_[edges_[from].cell] = kNoEdge;
    line.add(edges_[from].at.cast<double>());
    if (line.count >= kLeastPoints) line.fit();
  }
  return from;
}

// The nearest free point ahead that fits: on the line, or one pixel beside it.
std::optional<std::size_t> EdgeLines::next(std::size_t from, double sense, const Line& line) const {
  const Eigen::Vector2d foot = line.foot(edges_[from].at.cast<double>());
  const Eigen::Vector2d size = line.direction.cwiseAbs();
  const Eigen::Vector2d step = line.direction * (sense / size.maxCoeff());
  const std::ptrdiff_t beside = size.x() >= size.y() ? width_ : 1;
  for (int k = 1; k <= config_.gap_px + 1; ++k) {
    const Eigen::Vector2d ahead = foot + k * step;
    const auto column = static_cast<std::ptrdiff_t>(std::lround(ahead.x()));
    const auto row = static_cast<std::ptrdiff_t>(std::lround(ahead.y()));
    if (column < kMargin || row < kMargin || column >= width_ - kMargin ||
        row >= height_ - kMargin) {
      return std::nullopt;
    }
    for (const std::ptrdiff_t aside : {std::ptrdiff_t{0}, -beside, beside}) {
      const std::int32_t found = edge_at_[static_cast<std::size_t>(row * width_ + column + aside)];
      if (found == kNoEdge) continue;
      const auto candidate = static_cast<std::size_t>(found);
      if (fits(edges_[candidate], line)) return candidate;
    }
  }
  return std::nullopt;
}

bool EdgeLines::fits(const Edge& edge, const Line& line) const {
  const double alignment =
      edge.normal.y() * line.direction.x() - edge.normal.x() * line.direction.y();
  return alignment >= min_alignment_ &&
         line.distance(edge.at.cast<double>()) <= config_.distance_px;
}

}  // namespace vpdr::vision
