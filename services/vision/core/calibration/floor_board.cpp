#include "vision/core/calibration/floor_board.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace vpdr::vision {
namespace {

constexpr double kEdgeOn = 0.02;  // cosine between the view and the floor's normal

// Corners as an ideal camera of focal length one sees them.
std::vector<cv::Point2d> to_plane(const std::vector<cv::Point2f>& corners,
                                  const CameraModel& camera) {
  std::vector<cv::Point2d> out;
  for (const cv::Point2f& c : corners) {
    const Eigen::Vector3d ray = camera.ray({c.x, c.y});
    if (ray.z() < 1e-3) return {};
    out.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
  }
  return out;
}

struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< camera from board
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double rms_px = 0.0;
  double range_sigma_share = 0.0;  ///< of the distance
};

// The distance follows from the board's size in the image: its relative uncertainty is that of the
// corners over the board's extent.
double range_sigma(const std::vector<cv::Point2f>& corners, double rms_px) {
  cv::Point2f mean(0, 0);
  for (const cv::Point2f& c : corners) mean += c;
  const auto n = static_cast<double>(corners.size());
  mean *= 1.0 / n;
  double spread = 0.0;
  for (const cv::Point2f& c : corners) spread += (c - mean).dot(c - mean);
  return rms_px / std::sqrt(std::max(spread, 1e-9));
}

std::optional<Pose> pose_of(const std::vector<cv::Point2f>& corners, const Chessboard& board,
                            const CameraModel& camera) {
  const std::vector<cv::Point2d> plane = to_plane(corners, camera);
  if (plane.size() != corners.size()) return std::nullopt;
  std::vector<cv::Point3d> points;
  for (const cv::Point3f& p : board.points()) points.emplace_back(p.x, p.y, p.z);
  if (points.size() != plane.size()) return std::nullopt;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::Mat errors;
  const cv::Mat ideal = cv::Mat::eye(3, 3, CV_64F);
  try {
    cv::solvePnPGeneric(points, plane, ideal, cv::noArray(), rotations, translations, false,
                        cv::SOLVEPNP_IPPE, cv::noArray(), cv::noArray(), errors);
    if (rotations.empty()) return std::nullopt;
    cv::solvePnPRefineLM(points, plane, ideal, cv::noArray(), rotations[0], translations[0]);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  Pose pose;
  cv::Mat matrix;
  cv::Rodrigues(rotations[0], matrix);
  cv::cv2eigen(matrix, pose.rotation);
  pose.translation = {translations[0].at<double>(0), translations[0].at<double>(1),
                      translations[0].at<double>(2)};
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p =
        pose.rotation * Eigen::Vector3d(points[i].x, points[i].y, points[i].z) + pose.translation;
    if (!(p.z() > 0.0)) return std::nullopt;
    squares += (p.head<2>() / p.z() - Eigen::Vector2d(plane[i].x, plane[i].y)).squaredNorm();
  }
  pose.rms_px = camera.focal_px() * std::sqrt(squares / static_cast<double>(points.size()));
  pose.range_sigma_share = range_sigma(corners, pose.rms_px);
  return pose;
}

}  // namespace

double height_over_plane(const Eigen::Vector3d& up, const Eigen::Vector3d& point_m) {
  return -up.dot(point_m);
}

std::optional<FloorView> measure_floor(const std::vector<cv::Point2f>& corners,
                                       const Chessboard& board, const CameraModel& camera) {
  const std::optional<Pose> pose = pose_of(corners, board, camera);
  if (!pose) return std::nullopt;
  const Eigen::Vector3d middle(0.5 * (board.columns - 1) * board.square_m,
                               0.5 * (board.rows - 1) * board.square_m, 0.0);
  FloorView view;
  view.t_camera_board = pose->rotation * middle + pose->translation;
  view.up = pose->rotation.col(2);
  // The side of the board that is seen is its upper side.
  if (view.up.dot(view.t_camera_board) > 0.0) view.up = -view.up;
  view.height_m = height_over_plane(view.up, view.t_camera_board);
  if (view.height_m < kEdgeOn * view.t_camera_board.norm()) return std::nullopt;
  view.pitch_rad = std::asin(std::clamp(view.up.z(), -1.0, 1.0));
  view.roll_rad = std::atan2(-view.up.x(), -view.up.y());
  view.printed_height_m = view.t_camera_board.y();
  view.rms_px = pose->rms_px;
  view.height_sigma_m = view.height_m * pose->range_sigma_share;
  return view;
}

}  // namespace vpdr::vision
