#include "vpdr/camera/live_boards.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/errors.hpp"

namespace vpdr::tool {
namespace {

double mean_move(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += cv::norm(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

bool is_new(const std::vector<cv::Point2f>& corners, const BoardImages& found, double least_px) {
  return std::all_of(found.views.begin(), found.views.end(), [&](const vision::BoardView& v) {
    return mean_move(v.corners, corners) > least_px;
  });
}

cv::Mat to_grey(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return grey;
}

}  // namespace

BoardImages watch_boards(vision::Grabber& grabber, const std::string& camera,
                         const vision::Chessboard& board, const LiveBoardsOptions& options,
                         const std::function<void(const std::string&)>& tell) {
  if (!grabber.open()) {
    throw DeviceFault(camera + ": no such camera, or in use; see v4l2-ctl --list-devices");
  }
  BoardImages found;
  std::size_t failed = 0;
  cv::Mat image;
  for (std::size_t frame = 0; frame < options.max_frames && found.views.size() < options.views;
       ++frame) {
    if (!grabber.grab(image) || image.empty() || image.depth() != CV_8U) {
      if (++failed >= options.max_failed_grabs) {
        throw DeviceFault(camera + ": gives no images; plug it in again");
      }
      continue;
    }
    failed = 0;
    found.size = image.size();
    auto corners = vision::find_corners(to_grey(image), board);
    if (!corners || !is_new(*corners, found, options.least_move * image.cols)) continue;
    found.views.push_back({"frame " + std::to_string(frame), std::move(*corners)});
    const double share = vision::coverage_of(found.views, found.size).share;
    tell("view " + std::to_string(found.views.size()) + " of " + std::to_string(options.views) +
         ", corners in " + std::to_string(std::lround(100.0 * share)) + " % of the image's cells");
  }
  return found;
}

}  // namespace vpdr::tool
