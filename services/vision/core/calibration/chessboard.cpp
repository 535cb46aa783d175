#include "vision/core/calibration/chessboard.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

// The search window of a corner must not reach its neighbours.
constexpr double kWindowShare = 0.35;
constexpr int kLargestWindow = 11;
constexpr int kSmallestWindow = 2;

double smallest_spacing(const std::vector<cv::Point2f>& corners, int columns) {
  double smallest = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) == 0) continue;
    smallest = std::min(smallest, cv::norm(corners[i] - corners[i - 1]));
  }
  for (std::size_t i = static_cast<std::size_t>(columns); i < corners.size(); ++i) {
    smallest =
        std::min(smallest, cv::norm(corners[i] - corners[i - static_cast<std::size_t>(columns)]));
  }
  return smallest;
}

bool find_roughly(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>& corners) {
  const int flags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
  if (cv::findChessboardCorners(grey, size, corners, flags | cv::CALIB_CB_FAST_CHECK)) return true;
  return cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE);
}

}  // namespace

std::vector<cv::Point3f> Chessboard::points() const {
  std::vector<cv::Point3f> out;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      out.emplace_back(static_cast<float>(column * square_m), static_cast<float>(row * square_m),
                       0.0F);
    }
  }
  return out;
}

std::optional<std::vector<cv::Point2f>> find_corners(const cv::Mat& grey, const Chessboard& board) {
  if (grey.empty() || grey.type() != CV_8UC1) return std::nullopt;
  std::vector<cv::Point2f> corners;
  try {
    if (!find_roughly(grey, {board.columns, board.rows}, corners)) return std::nullopt;
    const double spacing = smallest_spacing(corners, board.columns);
    const int window =
        std::clamp(static_cast<int>(kWindowShare * spacing), kSmallestWindow, kLargestWindow);
    cv::cornerSubPix(grey, corners, {window, window}, {-1, -1},
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-3});
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  return corners;
}

}  // namespace vpdr::vision
