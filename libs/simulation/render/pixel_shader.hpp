#pragma once
// What one pixel sees: follows its ray to wall, floor, ceiling, step or solid and averages that
// surface's look over the pixel's footprint. Single precision; thread-safe; allocates nothing.
#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "simulation/render/scene.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

/// Where the eye is, and the solids that stand about.
struct View {
  Eigen::Vector3f eye_m = Eigen::Vector3f::Zero();
  int cell = -1;  ///< of the floor plan, where the eye is
  std::vector<SolidInView> solids{};
};

/// A ray in the world with how it moves from one pixel to the next.
struct Ray {
  Eigen::Vector3f direction;
  Eigen::Vector3f step_x;
  Eigen::Vector3f step_y;
};

/// Which of the view's solids a ray may meet.
using Candidates = std::span<const std::uint16_t>;

struct Shaded {
  float brightness = 0.0F;  ///< 0 black to 1 white, more where the lamp itself is seen
  int surface = 0;          ///< differs between walls, floor, ceiling and faces of solids
};

class PixelShader {
 public:
  explicit PixelShader(const Scene& scene) : scene_(scene) {}

  /// What a ray from the eye, which must be in free space, sees.
  [[nodiscard]] Shaded shade(const View& view, const Ray& ray, Candidates candidates) const;
  /// How far it sees, in lengths of its direction.
  [[nodiscard]] float distance(const View& view, const Eigen::Vector3f& direction,
                               Candidates candidates) const;

 private:
  /// The nearest solid before the end of sight.
  struct Nearest {
    int solid = -1;
    SolidInView::Entry entry;
  };

  static Nearest nearest(const View& view, const Eigen::Vector3f& direction, Candidates candidates,
                         float limit);
  static float footprint(const Ray& ray, float distance, int axis, int normal_axis);
  [[nodiscard]] float wall(const View& view, const Ray& ray, const Sight& sight) const;
  [[nodiscard]] float step(const View& view, const Ray& ray, const Sight& sight) const;
  [[nodiscard]] float floor(const View& view, const Ray& ray, const Sight& sight) const;
  [[nodiscard]] float ceiling(const View& view, const Ray& ray, const Sight& sight) const;
  [[nodiscard]] float solid(const View& view, const Ray& ray, const Nearest& hit) const;
  [[nodiscard]] float lamp_in_floor(const View& view, const Ray& ray, const Eigen::Vector3f& place,
                                    int cell, const Footprint& x, const Footprint& y) const;

  const Scene& scene_;
};

}  // namespace vpdr::simulation
