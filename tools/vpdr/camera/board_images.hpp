#pragma once
// Chessboard images into a camera calibration, and what people are told of it.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dataset/camera_calibration.hpp"
#include "vision/core/calibration/floor_board.hpp"
#include "vision/core/calibration/intrinsics.hpp"

namespace vpdr::tool {

struct BoardImages {
  std::vector<vision::BoardView> views;
  std::vector<std::string>
      without;  ///< images in which the board is not wholly seen, or unreadable
  cv::Size size;
};

/// Looks for the board in every image. `progress` gets the share done. Throws FileFault where the
/// images differ in size.
BoardImages find_boards(const std::vector<std::filesystem::path>& files,
                        const vision::Chessboard& board,
                        const std::function<void(double)>& progress);

/// The floor's board in one image; throws FileFault where it is not seen.
vision::FloorView floor_in(const std::filesystem::path& file, const vision::Chessboard& board,
                           const vision::CameraModel& camera);

/// Parameters with their standard deviations, residuals of the views, a map of the coverage.
std::string describe(const vision::IntrinsicsCalibration& calibration);
std::string describe(const vision::FloorView& floor);

/// As the camchain file holds it; the mounting stays unknown.
dataset::CameraCalibration to_file(const vision::CameraParameters& camera);

}  // namespace vpdr::tool
