#pragma once
// Chessboard views from a live camera: a view is kept when the board is held differently from all
// the views before.
#include <cstddef>
#include <functional>
#include <string>

#include "vision/source/live_camera.hpp"
#include "vpdr/camera/board_images.hpp"

namespace vpdr::tool {

struct LiveBoardsOptions {
  std::size_t views = 25;
  double least_move = 0.06;           ///< mean move of the corners between views, of the width
  std::size_t max_frames = 18'000;    ///< looked at before giving up: ten minutes at 30 a second
  std::size_t max_failed_grabs = 50;  ///< in a row
};

/// Grabs until there are enough views, or frames without end; `tell` gets a line for each view.
/// Throws DeviceFault where the camera cannot be opened or falls silent.
BoardImages watch_boards(vision::Grabber& grabber, const std::string& camera,
                         const vision::Chessboard& board, const LiveBoardsOptions& options,
                         const std::function<void(const std::string&)>& tell);

}  // namespace vpdr::tool
