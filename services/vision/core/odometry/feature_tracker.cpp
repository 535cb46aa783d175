#include "vision/core/odometry/feature_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/video/tracking.hpp>

namespace vpdr::vision {
namespace {

constexpr int kMarginPx = 4;    // nearer to the border no window is whole enough
constexpr int kFlowSteps = 20;  // of one level, at most
constexpr double kFlowEndPx = 0.02;
constexpr int kBackLevels = 1;  // the way back starts where it should end
constexpr int kLeastLevels = 1;
constexpr double kReachShare = 0.2;  // of the window: flow on one level finds what is so near
constexpr std::size_t kLeastMisses = 10;
constexpr double kLeastFound = 0.25;  // of the points, or the expectation was wrong
constexpr int kCornerBlockPx = 3;

cv::Point2f to_point(const Eigen::Vector2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

}  // namespace

FeatureTracker::FeatureTracker(const FeatureTrackerConfig& config, const CameraModel& camera)
    : config_(config),
      camera_(camera),
      clahe_(cv::createCLAHE(config.clahe_clip, {config.clahe_tiles, config.clahe_tiles})),
      levels_(config.flow_levels) {}

void FeatureTracker::reset() {
  tracks_.features.clear();
  levels_ = config_.flow_levels;
  pyramid_.clear();
  last_pyramid_.clear();
}

const FeatureTracks& FeatureTracker::track(const cv::Mat& grey, TimestampNs stamp_ns,
                                           std::span<const Eigen::Vector3d> expected) {
  prepare(grey);
  if (!tracks_.features.empty() && !last_pyramid_.empty()) follow(expected);
  keep_the_good(grey.cols, grey.rows);
  fill_up(even_);
  tracks_.stamp_ns = stamp_ns;
  return tracks_;
}

void FeatureTracker::prepare(const cv::Mat& grey) {
  std::swap(pyramid_, last_pyramid_);
  clahe_->apply(grey, even_);
  cv::buildOpticalFlowPyramid(even_, pyramid_, {config_.flow_window_px, config_.flow_window_px},
                              config_.flow_levels, true);
}

void FeatureTracker::begin_where(std::span<const Eigen::Vector3d> expected) {
  const std::size_t count = tracks_.features.size();
  from_.clear();
  expected_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    from_.push_back(to_point(tracks_.features[i].pixel));
    expected_.push_back(from_.back());
    if (expected.size() != count) continue;
    if (const auto pixel = camera_.pixel(expected[i])) expected_.back() = to_point(*pixel);
  }
}

void FeatureTracker::follow(std::span<const Eigen::Vector3d> expected) {
  begin_where(expected);
  const std::size_t found = seek(expected_, levels_);
  if (static_cast<double>(found) < kLeastFound * static_cast<double>(from_.size()))
    seek(from_, config_.flow_levels);
  learn_reach();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < from_.size(); ++i) {
    if (found_[i] == 0) continue;
    TrackedFeature& f = tracks_.features[kept++];
    f = tracks_.features[i];
    f.pixel = {to_[i].x, to_[i].y};
    f.ray = camera_.ray(f.pixel);
    ++f.age;
  }
  tracks_.features.resize(kept);
}

// There, beginning at `starts`, and back again; returns how many points were found.
std::size_t FeatureTracker::seek(const std::vector<cv::Point2f>& starts, int levels) {
  const cv::Size window(config_.flow_window_px, config_.flow_window_px);
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kFlowSteps,
                                  kFlowEndPx);
  to_ = starts;
  cv::calcOpticalFlowPyrLK(last_pyramid_, pyramid_, from_, to_, found_, cv::noArray(), window,
                           levels, criteria, cv::OPTFLOW_USE_INITIAL_FLOW);
  back_ = from_;
  cv::calcOpticalFlowPyrLK(pyramid_, last_pyramid_, to_, back_, found_back_, cv::noArray(), window,
                           std::min(kBackLevels, levels), criteria, cv::OPTFLOW_USE_INITIAL_FLOW);
  std::size_t found = 0;
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const cv::Point2f miss = back_[i] - from_[i];
    const bool returned = std::hypot(miss.x, miss.y) <= config_.max_return_px;
    found_[i] = found_[i] != 0 && found_back_[i] != 0 && returned ? 1 : 0;
    found += found_[i];
  }
  return found;
}

// How far off most of the points were tells on how many levels the next ones are within reach.
void FeatureTracker::learn_reach() {
  misses_px_.clear();
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const cv::Point2f miss = to_[i] - expected_[i];
    if (found_[i] != 0) misses_px_.push_back(std::hypot(miss.x, miss.y));
  }
  levels_ = config_.flow_levels;
  if (misses_px_.size() < kLeastMisses) return;
  const auto most = misses_px_.begin() + static_cast<std::ptrdiff_t>(0.9 * misses_px_.size());
  std::nth_element(misses_px_.begin(), most, misses_px_.end());
  const double within_px = kReachShare * config_.flow_window_px;
  while (levels_ > kLeastLevels && *most < within_px * (1 << (levels_ - 1))) --levels_;
}

// Drops what has left the image, and of two points that have met the younger one.
void FeatureTracker::keep_the_good(int width, int height) {
  const double square = std::max(1.0, 0.5 * config_.min_distance_px);
  claimed_columns_ = static_cast<int>(width / square) + 1;
  claimed_.assign(
      static_cast<std::size_t>(claimed_columns_) * (static_cast<std::size_t>(height / square) + 1),
      0);
  std::erase_if(tracks_.features, [&](const TrackedFeature& f) {
    return !(f.pixel.x() >= kMarginPx) || !(f.pixel.y() >= kMarginPx) ||
           !(f.pixel.x() < width - kMarginPx) || !(f.pixel.y() < height - kMarginPx) ||
           !claim(to_point(f.pixel));
  });
}

// False where another point is nearer than about the least distance.
bool FeatureTracker::claim(const cv::Point2f& pixel) {
  const double square = std::max(1.0, 0.5 * config_.min_distance_px);
  const int column = static_cast<int>(pixel.x / square);
  const int row = static_cast<int>(pixel.y / square);
  const int rows = static_cast<int>(claimed_.size()) / claimed_columns_;
  for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(claimed_columns_ - 1, column + 1); ++x) {
      if (claimed_[static_cast<std::size_t>(y * claimed_columns_ + x)] != 0) return false;
    }
  }
  claimed_[static_cast<std::size_t>(row * claimed_columns_ + column)] = 1;
  return true;
}

// New corners in cells without a point. The cells take turns in an order that spreads them over the
// image, for there may be more of them than points wanted.
void FeatureTracker::fill_up(const cv::Mat& image) {
  const int columns = std::max(1, image.cols / config_.cell_px);
  const int rows = std::max(1, image.rows / config_.cell_px);
  const int cells = columns * rows;
  occupied_.assign(static_cast<std::size_t>(cells), 0);
  for (const TrackedFeature& f : tracks_.features) {
    const int column = std::min(columns - 1, static_cast<int>(f.pixel.x()) * columns / image.cols);
    const int row = std::min(rows - 1, static_cast<int>(f.pixel.y()) * rows / image.rows);
    occupied_[static_cast<std::size_t>(row * columns + column)] = 1;
  }
  constexpr int kStride = 7919;  // a prime above any number of cells visits each of them once
  for (int i = 0; i < cells; ++i) {
    if (tracks_.features.size() >= static_cast<std::size_t>(config_.max_features)) return;
    const int cell = static_cast<int>((static_cast<long>(i) * kStride) % cells);
    if (occupied_[static_cast<std::size_t>(cell)] != 0) continue;
    const int column = cell % columns;
    const int row = cell / columns;
    const int left = std::max(kMarginPx, column * image.cols / columns);
    const int top = std::max(kMarginPx, row * image.rows / rows);
    const int right = std::min(image.cols - kMarginPx, (column + 1) * image.cols / columns);
    const int bottom = std::min(image.rows - kMarginPx, (row + 1) * image.rows / rows);
    if (right > left && bottom > top) {
      add_best_corner(image, {left, top, right - left, bottom - top});
    }
  }
}

void FeatureTracker::add_best_corner(const cv::Mat& image, const cv::Rect& cell) {
  cv::cornerMinEigenVal(image(cell), score_, kCornerBlockPx);
  double best = 0.0;
  cv::Point at;
  cv::minMaxLoc(score_, nullptr, &best, nullptr, &at);
  if (best < config_.min_corner_score) return;
  const cv::Point2f pixel(static_cast<float>(cell.x + at.x), static_cast<float>(cell.y + at.y));
  if (!claim(pixel)) return;
  TrackedFeature f;
  f.id = next_id_++;
  f.pixel = {pixel.x, pixel.y};
  f.ray = camera_.ray(f.pixel);
  tracks_.features.push_back(f);
}

}  // namespace vpdr::vision
