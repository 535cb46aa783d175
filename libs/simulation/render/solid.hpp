#pragma once
// Upright boxes that stand in a scene: furniture, and the parts of people who pass by. World ENU,
// metres; shades are reflectances.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/render/box_filter.hpp"

namespace vpdr::simulation {

/// A rectangle of one shade on an upright face: `along` from its left end, `up` from its foot.
struct Patch {
  Interval along;
  Interval up;
  float shade = 0.0F;
};

/// A box turned about the vertical.
struct Solid {
  Eigen::Vector3f foot_m = Eigen::Vector3f::Zero();  ///< middle of its lower face
  Eigen::Vector3f size_m = Eigen::Vector3f::Ones();  ///< along its own x and y, and upwards
  float yaw_rad = 0.0F;                              ///< of its x
  float shade = 0.5F;
  /// Painted on the two faces across x (along counts on y from its low end) and across y.
  std::array<std::vector<Patch>, 2> faces{};
};

/// A box as an eye sees it: everything in the box's own axes, from the middle of its foot.
struct SolidInView {
  const Solid* solid = nullptr;
  float cosine = 1.0F, sine = 0.0F;  ///< of its yaw
  Eigen::Vector3f eye_m = Eigen::Vector3f::Zero();

  SolidInView(const Solid& of, const Eigen::Vector3f& eye_world_m);
  [[nodiscard]] Eigen::Vector3f turned(const Eigen::Vector3f& world) const {
    return {cosine * world.x() + sine * world.y(), cosine * world.y() - sine * world.x(),
            world.z()};
  }
  /// Where a ray along `direction` (own axes) enters the box.
  struct Entry {
    float distance = -1.0F;  ///< in lengths of direction; negative: it misses, or starts inside
    int axis = 0;            ///< across which the face lies that it enters by
  };
  [[nodiscard]] Entry enter(const Eigen::Vector3f& direction) const;
};

/// Middle and radius of a ball around the box.
struct Ball {
  Eigen::Vector3f middle_m = Eigen::Vector3f::Zero();
  float radius_m = 0.0F;
};
Ball ball_around(const Solid& solid);

}  // namespace vpdr::simulation
