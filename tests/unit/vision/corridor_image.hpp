#pragma once
// A drawn corridor whose direction is known exactly: walls, floor and ceiling with doors, lamps
// and tiles as flat quads, seen by a pinhole or distorted camera.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/core/camera_model.hpp"
#include "vision/core/heading/line_segments.hpp"

namespace vpdr::vision::testing {

/// A pinhole of 640 x 480 pixels, f = 500 px, centre (319.5, 239.5).
CameraParameters plain_camera();

/// camera_from_corridor (columns: corridor forward, left, up) of a camera with this heading
/// (counter-clockwise), pitch (up) and roll (its right side down), radians.
Eigen::Matrix3d looking(double heading, double pitch, double roll);

/// Draws the corridor (4.8 m wide, 2.6 m high, endless both ways, doors and lamps along it).
cv::Mat draw_corridor(const CameraModel& camera, const Eigen::Matrix3d& camera_from_corridor);

/// Random but seeded segments: `along[i]` segments along direction i of the corridor (forward,
/// left, up) and `clutter` in any direction, end points disturbed by `noise_px`.
std::vector<LineSegment> random_segments(const CameraModel& camera,
                                         const Eigen::Matrix3d& camera_from_corridor,
                                         const std::vector<int>& along, int clutter,
                                         double noise_px, unsigned seed);

}  // namespace vpdr::vision::testing
