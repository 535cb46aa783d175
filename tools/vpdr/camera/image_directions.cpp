#include "vpdr/camera/image_directions.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <ostream>
#include <utility>

#include "core/errors.hpp"
#include "vision/source/image_file.hpp"

namespace vpdr::tool {
namespace {

using vision::DirectionsSeen;
using vision::FrameOutcome;

constexpr double kMicroseconds = 1e3;

void write_drawing(const std::filesystem::path& file, const cv::Mat& drawing) {
  bool written = false;
  try {
    written = cv::imwrite(file.string(), drawing);
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) {
    throw FileFault(file.string() + ": drawing cannot be written; is the folder writable?");
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileFault(folder.string() + ": " + error.message() + "; choose another folder");
}

}  // namespace

std::string directions_line(const std::string& name, const DirectionsSeen& seen, double time_ms) {
  using Json = nlohmann::ordered_json;
  Json directions = Json::array();
  Json sigmas = Json::array();
  Json inliers = Json::array();
  const bool found = seen.outcome == FrameOutcome::kFound;
  for (std::size_t i = 0; found && i < 3; ++i) {
    const Eigen::Vector3d& d = seen.directions[i];
    directions.push_back({d.x(), d.y(), d.z()});
    sigmas.push_back(seen.sigma_rad[i]);
    inliers.push_back(seen.frame->inliers[i]);
  }
  Json line{{"image", name}};
  line["directions"] = std::move(directions);
  line["sigma_rad"] = std::move(sigmas);
  line["inliers"] = std::move(inliers);
  if (!found) line["reason"] = name_of(seen.outcome);
  line["time_ms"] = std::round(time_ms * kMicroseconds) / kMicroseconds;
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

cv::Mat draw_directions(const cv::Mat& grey, const vision::BuildingDirections& directions,
                        const DirectionsSeen& seen, double inlier_angle_rad) {
  static const std::array<cv::Scalar, 3> kColours{cv::Scalar(40, 40, 230), cv::Scalar(60, 190, 40),
                                                  cv::Scalar(230, 120, 30)};
  cv::Mat drawing;
  cv::cvtColor(grey, drawing, cv::COLOR_GRAY2BGR);
  if (!seen.frame) return drawing;
  for (const vision::SphereSegment& s : directions.lifted()) {
    const auto direction = direction_of(s, seen.frame->camera_from_corridor, inlier_angle_rad);
    const vision::LineSegment& segment = directions.segments()[s.source];
    const cv::Scalar colour =
        direction ? kColours[static_cast<std::size_t>(*direction)] : cv::Scalar(150, 150, 150);
    cv::line(drawing, cv::Point2d(segment.start_px.x(), segment.start_px.y()),
             cv::Point2d(segment.end_px.x(), segment.end_px.y()), colour, direction ? 2 : 1,
             cv::LINE_AA);
  }
  return drawing;
}

void print_directions(const std::vector<std::filesystem::path>& files,
                      const vision::CameraModel& camera, const ImageDirectionsOptions& options,
                      std::ostream& out, std::ostream& problems) {
  cv::setNumThreads(1);  // time_ms is that of one core
  if (!options.draw.empty()) make_folder(options.draw);
  vision::BuildingDirections directions(options.directions, camera);
  for (const std::filesystem::path& file : files) {
    const auto read = vision::read_image(file);
    if (!read) problems << read.error().message << "\n";
    const cv::Mat image = read ? read.value() : cv::Mat();
    const auto start = std::chrono::steady_clock::now();
    const DirectionsSeen seen = directions.look(image, options.vertical);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    out << directions_line(file.stem().string(), seen, taken.count()) << std::endl;
    if (options.draw.empty() || image.empty()) continue;
    write_drawing(options.draw / (file.stem().string() + ".png"),
                  draw_directions(image, directions, seen,
                                  options.directions.search.refine.inlier_angle_rad));
  }
}

}  // namespace vpdr::tool
