#include "simulation/render/solid.hpp"

#include <cmath>
#include <limits>

namespace vpdr::simulation {

using Eigen::Vector3f;

SolidInView::SolidInView(const Solid& of, const Vector3f& eye_world_m)
    : solid(&of), cosine(std::cos(of.yaw_rad)), sine(std::sin(of.yaw_rad)) {
  eye_m = turned(eye_world_m - of.foot_m);
}

SolidInView::Entry SolidInView::enter(const Vector3f& direction) const {
  // Slabs (Kay and Kajiya 1986): inside all three from the last entry to the first exit.
  float entry = -std::numeric_limits<float>::infinity();
  float exit = std::numeric_limits<float>::infinity();
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const float half = 0.5F * solid->size_m[i];
    const float off = i == 2 ? half - eye_m[i] : -eye_m[i];
    const float d = direction[i];
    if (std::abs(d) < 1e-9F) {
      if (std::abs(off) > half) return {};
      continue;
    }
    const float per = 1.0F / d, reach = std::abs(per) * half;
    const float first = off * per - reach;
    if (first > entry) {
      entry = first;
      axis = i;
    }
    exit = std::min(exit, off * per + reach);
  }
  if (entry > exit || entry <= 0.0F) return {};
  return {entry, axis};
}

Ball ball_around(const Solid& solid) {
  return {solid.foot_m + Vector3f(0.0F, 0.0F, 0.5F * solid.size_m.z()), 0.5F * solid.size_m.norm()};
}

}  // namespace vpdr::simulation
