#pragma once
// What one pixel sees: follows its ray to wall, floor or ceiling and averages that surface's look
// over the pixel's footprint. Single precision; thread-safe; allocates nothing.
#include <Eigen/Core>

#include "simulation/scene.hpp"

namespace vpdr::simulation {

/// The camera at one instant, in the world.
struct View {
  Eigen::Vector3f eye_m = Eigen::Vector3f::Zero();
  Eigen::Matrix3f world_from_camera = Eigen::Matrix3f::Identity();
  int cell = -1;         ///< of the floor plan, where the eye is
  float pixel_x = 0.0F;  ///< size of a pixel in normalised image coordinates
  float pixel_y = 0.0F;
};

struct Shaded {
  float brightness = 0.0F;  ///< 0 black to 1 white, more where the lamp itself is seen
  int surface = 0;          ///< differs between walls, floor and ceiling
};

class PixelShader {
 public:
  explicit PixelShader(const Scene& scene);

  /// What the ray through undistorted normalised image coordinates (x, y) sees. The eye must be in
  /// a corridor.
  [[nodiscard]] Shaded shade(const View& view, float x, float y) const;

 private:
  /// A ray with how it moves from one pixel to the next.
  struct Ray {
    Eigen::Vector3f direction;
    Eigen::Vector3f step_x;
    Eigen::Vector3f step_y;
  };

  static float footprint(const Ray& ray, float distance, int axis, int normal_axis);
  [[nodiscard]] float wall(const View& view, const Ray& ray, float distance, int index) const;
  [[nodiscard]] float floor(const View& view, const Ray& ray, float distance, int cell) const;
  [[nodiscard]] float ceiling(const View& view, const Ray& ray, float distance, int cell) const;
  [[nodiscard]] float lamp_in_floor(const View& view, const Ray& ray, const Eigen::Vector2f& place,
                                    int cell, const Footprint& x, const Footprint& y) const;

  const Scene& scene_;
  float height_;
};

}  // namespace vpdr::simulation
