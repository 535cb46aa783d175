#include "vision/core/calibration/intrinsics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

namespace vpdr::vision {
namespace {

// Pixels of a corner count twice, once for each coordinate.
constexpr double kCoordinates = 2.0;
constexpr int kPoseParameters = 6;

struct Solved {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat coefficients;
  std::vector<cv::Mat> rotations, translations;
  std::vector<double> residuals_px;  ///< RMS of each view
  double rms_px = 0.0;
};

using Corners = std::vector<std::vector<cv::Point2f>>;
using Points = std::vector<std::vector<cv::Point3f>>;

bool is_fisheye(const IntrinsicsConfig& config) { return config.lens == Distortion::kEquidistant; }

void project(const Solved& s, std::size_t view, const std::vector<cv::Point3f>& points,
             bool fisheye, std::vector<cv::Point2f>& pixels, cv::Mat& jacobian) {
  if (fisheye) {
    cv::fisheye::projectPoints(points, pixels, s.rotations[view], s.translations[view], s.matrix,
                               s.coefficients, 0.0, jacobian);
  } else {
    cv::projectPoints(points, s.rotations[view], s.translations[view], s.matrix, s.coefficients,
                      pixels, jacobian);
  }
}

void measure_residuals(const Corners& corners, const Points& points, bool fisheye, Solved& s) {
  double sum = 0.0;
  double count = 0.0;
  s.residuals_px.clear();
  std::vector<cv::Point2f> pixels;
  cv::Mat jacobian;
  for (std::size_t view = 0; view < corners.size(); ++view) {
    project(s, view, points[view], fisheye, pixels, jacobian);
    double squares = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const cv::Point2f off = pixels[i] - corners[view][i];
      squares += off.dot(off);
    }
    s.residuals_px.push_back(std::sqrt(squares / static_cast<double>(pixels.size())));
    sum += squares;
    count += static_cast<double>(pixels.size());
  }
  s.rms_px = std::sqrt(sum / count);
}

Solved solve(const Corners& corners, const Chessboard& board, cv::Size image,
             const IntrinsicsConfig& config) {
  Solved s;
  const Points points(corners.size(), board.points());
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 200, 1e-10);
  if (is_fisheye(config)) {
    s.coefficients = cv::Mat::zeros(4, 1, CV_64F);
    cv::fisheye::calibrate(
        points, corners, image, s.matrix, s.coefficients, s.rotations, s.translations,
        cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW, until);
  } else {
    const int flags = config.third_radial ? 0 : cv::CALIB_FIX_K3;
    s.coefficients = cv::Mat::zeros(5, 1, CV_64F);
    cv::calibrateCamera(points, corners, image, s.matrix, s.coefficients, s.rotations,
                        s.translations, flags, until);
  }
  measure_residuals(corners, points, is_fisheye(config), s);
  return s;
}

// Columns of OpenCV's Jacobians: pinhole rotation, translation, f, c, coefficients; fisheye f, c,
// coefficients, rotation, translation, skew. Here: camera first, then the pose.
Eigen::MatrixXd camera_then_pose(const cv::Mat& jacobian, bool fisheye, int camera) {
  Eigen::MatrixXd j;
  cv::cv2eigen(jacobian, j);
  Eigen::MatrixXd out(j.rows(), camera + kPoseParameters);
  if (fisheye) {
    out << j.leftCols(camera), j.middleCols(camera, kPoseParameters);
  } else {
    out << j.middleCols(kPoseParameters, camera), j.leftCols(kPoseParameters);
  }
  return out;
}

// Standard deviations of f, c and the coefficients that were free: the poses are eliminated by
// the Schur complement, the noise is what the residuals show.
Eigen::VectorXd deviations(const Corners& corners, const Chessboard& board, const Solved& s,
                           const IntrinsicsConfig& config) {
  const bool fisheye = is_fisheye(config);
  const int camera = fisheye || !config.third_radial ? 8 : 9;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(camera, camera);
  const std::vector<cv::Point3f> points = board.points();
  std::vector<cv::Point2f> pixels;
  cv::Mat jacobian;
  double rows = 0.0;
  double squares = 0.0;
  for (std::size_t view = 0; view < corners.size(); ++view) {
    project(s, view, points, fisheye, pixels, jacobian);
    const Eigen::MatrixXd j = camera_then_pose(jacobian, fisheye, camera);
    const Eigen::MatrixXd full = j.transpose() * j;
    const Eigen::MatrixXd cross = full.topRightCorner(camera, kPoseParameters);
    const Eigen::MatrixXd pose = full.bottomRightCorner(kPoseParameters, kPoseParameters);
    information += full.topLeftCorner(camera, camera) - cross * pose.inverse() * cross.transpose();
    rows += static_cast<double>(j.rows());
    squares += s.residuals_px[view] * s.residuals_px[view] * static_cast<double>(points.size());
  }
  const double unknowns = camera + kPoseParameters * static_cast<double>(corners.size());
  const double variance = squares / std::max(1.0, rows - unknowns);
  return (variance * information.inverse().diagonal()).cwiseMax(0.0).cwiseSqrt();
}

double median(std::vector<double> v) {
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

// The worst view, if it is out of line with the others.
std::optional<std::size_t> outlier(const Solved& s, const IntrinsicsConfig& config) {
  const auto worst = std::max_element(s.residuals_px.begin(), s.residuals_px.end());
  const double limit =
      std::max(config.outlier_floor_px, config.outlier_factor * median(s.residuals_px));
  if (*worst <= limit) return std::nullopt;
  return static_cast<std::size_t>(worst - s.residuals_px.begin());
}

void describe(const Solved& s, const Eigen::VectorXd& sigma, cv::Size image,
              const IntrinsicsConfig& config, IntrinsicsCalibration& out) {
  CameraParameters& c = out.camera;
  c.width_px = image.width;
  c.height_px = image.height;
  c.fx_px = s.matrix.at<double>(0, 0);
  c.fy_px = s.matrix.at<double>(1, 1);
  c.cx_px = s.matrix.at<double>(0, 2);
  c.cy_px = s.matrix.at<double>(1, 2);
  c.distortion = config.lens;
  for (int i = 0; i < s.coefficients.rows && i < 5; ++i) {
    c.coefficients[static_cast<std::size_t>(i)] = s.coefficients.at<double>(i);
  }
  out.sigma.fx_px = sigma[0];
  out.sigma.fy_px = sigma[1];
  out.sigma.cx_px = sigma[2];
  out.sigma.cy_px = sigma[3];
  for (Eigen::Index i = 4; i < sigma.size(); ++i) {
    out.sigma.coefficients[static_cast<std::size_t>(i - 4)] = sigma[i];
  }
  out.rms_px = s.rms_px;
}

bool is_plausible(const IntrinsicsCalibration& c, cv::Size image) {
  const CameraParameters& p = c.camera;
  const bool finite = std::isfinite(p.fx_px + p.fy_px + p.cx_px + p.cy_px + c.rms_px);
  return finite && p.fx_px > 0.1 * image.width && p.fx_px < 20.0 * image.width && p.fy_px > 0.0 &&
         p.cx_px > 0.0 && p.cx_px < image.width && p.cy_px > 0.0 && p.cy_px < image.height;
}

Result<IntrinsicsCalibration> calibrate(const std::vector<BoardView>& views,
                                        const Chessboard& board, cv::Size image,
                                        const IntrinsicsConfig& config) {
  std::vector<BoardView> kept = views;
  std::vector<ViewResidual> dropped;
  while (true) {
    Corners corners;
    for (const BoardView& view : kept) corners.push_back(view.corners);
    const Solved s = solve(corners, board, image, config);
    const auto bad = outlier(s, config);
    if (bad && kept.size() > config.min_views) {
      dropped.push_back({kept[*bad].name, s.residuals_px[*bad], true});
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(*bad));
      continue;
    }
    IntrinsicsCalibration out;
    describe(s, deviations(corners, board, s, config), image, config, out);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      out.views.push_back({kept[i].name, s.residuals_px[i], false});
    }
    out.views.insert(out.views.end(), dropped.begin(), dropped.end());
    out.coverage = coverage_of(kept, image);
    if (!is_plausible(out, image)) {
      return Error{"the views give no plausible camera; take more, with the board tilted"};
    }
    return out;
  }
}

}  // namespace

Coverage coverage_of(const std::vector<BoardView>& views, cv::Size image) {
  Coverage coverage;
  for (const BoardView& view : views) {
    for (const cv::Point2f& p : view.corners) {
      const int column =
          static_cast<int>(p.x * Coverage::kColumns / static_cast<float>(image.width));
      const int row = static_cast<int>(p.y * Coverage::kRows / static_cast<float>(image.height));
      if (column < 0 || row < 0 || column >= Coverage::kColumns || row >= Coverage::kRows) continue;
      ++coverage.cells[static_cast<std::size_t>(row * Coverage::kColumns + column)];
    }
  }
  const auto seen = std::count_if(coverage.cells.begin(), coverage.cells.end(),
                                  [](int corners) { return corners > 0; });
  coverage.share = static_cast<double>(seen) / static_cast<double>(coverage.cells.size());
  return coverage;
}

Result<IntrinsicsCalibration> calibrate_intrinsics(const std::vector<BoardView>& views,
                                                   const Chessboard& board, cv::Size image,
                                                   const IntrinsicsConfig& config) {
  if (views.size() < config.min_views) {
    return Error{"the board is seen in " + std::to_string(views.size()) + " images, at least " +
                 std::to_string(config.min_views) +
                 " are needed; count its inner corners, and take more images"};
  }
  const auto expected = static_cast<std::size_t>(board.columns * board.rows);
  for (const BoardView& view : views) {
    if (view.corners.size() != expected) return Error{view.name + ": not all corners of the board"};
  }
  try {
    return calibrate(views, board, image, config);
  } catch (const cv::Exception& e) {
    return Error{"OpenCV cannot calibrate from these views (" + e.err +
                 "); take more, with the board tilted and near the edges of the image"};
  }
}

}  // namespace vpdr::vision
