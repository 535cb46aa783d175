#pragma once
// The camera's height above the floor, and its tilt, from a chessboard that lies on the floor
// (S1.9): the metric scale of what one camera sees of the ground. Camera axes: x right, y down,
// z forward; metres, radians. Pure functions, thread-safe; nothing is thrown.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/core/calibration/chessboard.hpp"
#include "vision/core/camera_model.hpp"

namespace vpdr::vision {

/// How the camera stands over the floor.
struct FloorView {
  double height_m = 0.0;
  double pitch_rad = 0.0;  ///< of the optical axis, positive looking up
  double roll_rad = 0.0;   ///< positive when the camera's right side is down
  double height_sigma_m = 0.0;
  double rms_px = 0.0;            ///< of the corners against the board's plane
  double printed_height_m = 0.0;  ///< S1.9 as printed: the rotation between board and camera is
                                  ///< taken as none, T_cp's downward part is the height
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();            ///< normal of the floor, camera axes
  Eigen::Vector3d t_camera_board = Eigen::Vector3d::Zero();  ///< T_cp: to the board's middle
};

/// The board's plane by its corners: all four ways of looking at a flat board that a PnP solver may
/// return are told apart by their residual. Nothing where the corners fit no board in front of the
/// camera, or the floor is seen edge-on.
std::optional<FloorView> measure_floor(const std::vector<cv::Point2f>& corners,
                                       const Chessboard& board, const CameraModel& camera);

/// S1.9 for known pose: height of the camera over the plane with this normal (up) through this
/// point, camera axes.
double height_over_plane(const Eigen::Vector3d& up, const Eigen::Vector3d& point_m);

}  // namespace vpdr::vision
