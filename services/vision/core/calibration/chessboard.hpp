#pragma once
// The inner corners of a chessboard in an image, to a fraction of a pixel. Board axes: x along a
// row of corners, y from row to row, z = 0. Pure functions, thread-safe; nothing is thrown, not by
// OpenCV either. Pixel (0, 0) is the centre of the upper left pixel.
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

namespace vpdr::vision {

/// A chessboard by its inner corners, as printed: a board of 10 x 7 squares has 9 x 6.
struct Chessboard {
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;

  /// Corners in board axes, row by row, metres.
  [[nodiscard]] std::vector<cv::Point3f> points() const;
};

/// Corners in the order of Chessboard::points(); nothing where the board is not wholly in view.
/// `grey`: 8 bits.
std::optional<std::vector<cv::Point2f>> find_corners(const cv::Mat& grey, const Chessboard& board);

}  // namespace vpdr::vision
