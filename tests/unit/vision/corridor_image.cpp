#include "tests/unit/vision/corridor_image.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace vpdr::vision::testing {
namespace {

constexpr double kNear = 0.15;
constexpr int kSub = 4;  // fractional bits of the drawn corners

using Polygon = std::vector<Eigen::Vector3d>;

// Clips at z = kNear in camera axes.
Polygon clipped(const Polygon& in) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Eigen::Vector3d& a = in[i];
    const Eigen::Vector3d& b = in[(i + 1) % in.size()];
    if (a.z() >= kNear) out.push_back(a);
    if ((a.z() >= kNear) != (b.z() >= kNear)) {
      out.push_back(a + (b - a) * ((kNear - a.z()) / (b.z() - a.z())));
    }
  }
  return out;
}

class Painter {
 public:
  Painter(const CameraModel& camera, const Eigen::Matrix3d& r) : camera_(camera), r_(r) {
    image_ = cv::Mat(camera.parameters().height_px, camera.parameters().width_px, CV_8UC1,
                     cv::Scalar(90));
  }

  // Corner a, edges u and v, in corridor axes seen from the eye; edges cut finely so that a
  // distorted line is drawn curved.
  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
            int grey) {
    const Polygon clip = clipped({r_ * a, r_ * (a + u), r_ * (a + u + v), r_ * (a + v)});
    std::vector<cv::Point> corners;
    for (std::size_t i = 0; i < clip.size(); ++i) {
      for (int k = 0; k < 16; ++k) {
        const Eigen::Vector3d p = clip[i] + (clip[(i + 1) % clip.size()] - clip[i]) * (k / 16.0);
        const auto pixel = camera_.pixel(p);
        if (!pixel) continue;
        const auto to_fixed = [](double x) {
          return static_cast<int>(std::lround(std::clamp(x, -2e4, 2e4) * (1 << kSub)));
        };
        corners.emplace_back(to_fixed(pixel->x()), to_fixed(pixel->y()));
      }
    }
    if (corners.size() > 2) cv::fillPoly(image_, corners, cv::Scalar(grey), cv::LINE_AA, kSub);
  }

  cv::Mat image() { return image_; }

 private:
  const CameraModel& camera_;
  Eigen::Matrix3d r_;
  cv::Mat image_;
};

}  // namespace

CameraParameters plain_camera() {
  CameraParameters p;
  p.width_px = 640;
  p.height_px = 480;
  p.fx_px = p.fy_px = 500.0;
  p.cx_px = 319.5;
  p.cy_px = 239.5;
  return p;
}

Eigen::Matrix3d looking(double heading, double pitch, double roll) {
  // corridor_from_body: yaw left, nose up is a negative turn about the left axis, right side down.
  const Eigen::Matrix3d corridor_from_body = (Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                                              Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY()) *
                                              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                                 .toRotationMatrix();
  return (corridor_from_body * forward_looking_body_from_camera()).transpose();
}

cv::Mat draw_corridor(const CameraModel& camera, const Eigen::Matrix3d& camera_from_corridor) {
  Painter paint(camera, camera_from_corridor);
  using V = Eigen::Vector3d;
  const double left = 2.6;
  const double right = -2.2;
  const double floor = -1.6;
  const double ceiling = 1.0;
  const double length = 60.0;
  paint.quad({-length, right, floor}, {2 * length, 0, 0}, {0, left - right, 0}, 120);
  paint.quad({-length, right, ceiling}, {2 * length, 0, 0}, {0, left - right, 0}, 200);
  paint.quad({-length, left, floor}, {2 * length, 0, 0}, {0, 0, ceiling - floor}, 160);
  paint.quad({-length, right, floor}, {2 * length, 0, 0}, {0, 0, ceiling - floor}, 180);
  for (const double wall : {left, right}) {  // skirting board and handrail
    paint.quad({-length, wall, floor}, {2 * length, 0, 0}, {0, 0, 0.12}, 50);
    paint.quad({-length, wall, -0.75}, {2 * length, 0, 0}, {0, 0, 0.08}, 70);
  }
  for (double x = -20.7; x < 25.0; x += 3.0) {
    paint.quad(V(x, left, floor), V(0.9, 0, 0), V(0, 0, 2.0), 60);
    paint.quad(V(x + 1.3, right, floor), V(0.9, 0, 0), V(0, 0, 2.0), 40);
    paint.quad(V(x + 1.2, left, -0.2), V(1.1, 0, 0), V(0, 0, 0.7), 230);
    paint.quad(V(x + 2.4, right, -0.3), V(0.4, 0, 0), V(0, 0, 0.5), 240);
    paint.quad(V(x, -0.2, ceiling), V(1.2, 0, 0), V(0, 0.4, 0), 250);
    paint.quad(V(x + 0.4, right, floor), V(0.1, 0, 0), V(0, left - right, 0), 90);
  }
  return paint.image();
}

std::vector<LineSegment> random_segments(const CameraModel& camera,
                                         const Eigen::Matrix3d& camera_from_corridor,
                                         const std::vector<int>& along, int clutter,
                                         double noise_px, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, noise_px > 0.0 ? noise_px : 1e-12);
  const CameraParameters& p = camera.parameters();
  std::vector<LineSegment> out;
  const auto add = [&](const Eigen::Vector3d& direction) {
    for (;;) {
      const Eigen::Vector2d middle(u(random) * p.width_px, u(random) * p.height_px);
      const Eigen::Vector3d point = camera.ray(middle) * 4.0;
      const double half = 0.15 + 0.5 * u(random);
      const auto a = camera.pixel(point - half * direction);
      const auto b = camera.pixel(point + half * direction);
      if (!a || !b || (*a - *b).norm() < 20.0 || (*a - *b).norm() > 400.0) continue;
      const auto disturb = [&] { return Eigen::Vector2d(noise(random), noise(random)); };
      out.push_back({*a + disturb(), *b + disturb()});
      return;
    }
  };
  for (std::size_t axis = 0; axis < along.size(); ++axis) {
    for (int i = 0; i < along[axis]; ++i) {
      add(camera_from_corridor.col(static_cast<Eigen::Index>(axis)));
    }
  }
  for (int i = 0; i < clutter; ++i) {
    add(Eigen::Vector3d(u(random) - 0.5, u(random) - 0.5, u(random) - 0.5).normalized());
  }
  return out;
}

}  // namespace vpdr::vision::testing
