#pragma once
// The three vanishing directions of single images, as lines of JSON. No image knows of another.
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "vision/core/heading/building_directions.hpp"

namespace vpdr::tool {

struct ImageDirectionsOptions {
  vision::DirectionsConfig directions;
  std::optional<vision::VerticalPrior> vertical;  ///< the same for all images
  std::filesystem::path draw;                     ///< folder for drawings; empty: none
};

/// {"image": name, "directions": [[x,y,z],...], "sigma_rad": [...], "inliers": [...],
/// "time_ms": t}: unit vectors in camera axes, main direction, its left, up. Without a result the
/// lists are empty and "reason" says why.
std::string directions_line(const std::string& name, const vision::DirectionsSeen& seen,
                            double time_ms);

/// Image in colour, its segments coloured by their direction: red the main one, green its left,
/// blue up, grey none.
cv::Mat draw_directions(const cv::Mat& grey, const vision::BuildingDirections& directions,
                        const vision::DirectionsSeen& seen, double inlier_angle_rad);

/// One line for each file to `out`; what is wrong with a file to `problems`. Throws FileFault
/// where a drawing cannot be written.
void print_directions(const std::vector<std::filesystem::path>& files,
                      const vision::CameraModel& camera, const ImageDirectionsOptions& options,
                      std::ostream& out, std::ostream& problems);

}  // namespace vpdr::tool
