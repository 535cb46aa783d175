#pragma once
// Specific force of a board on a made walker's trunk: upward, forward and across.
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/steps/step_detector.hpp"

namespace vpdr::pdr::made {

/// Instants at which a foot lands, and how much the body bounces there.
struct Footfall {
  double instant_s = 0.0;
  double bounce_mps2 = 3.0;
};

class TrunkOfAWalker {
 public:
  /// Stands for a second before the first and after the last footfall.
  explicit TrunkOfAWalker(std::vector<Footfall> falls) : falls_(std::move(falls)) {}

  [[nodiscard]] double end_s() const { return falls_.back().instant_s + 1.0; }

  /// Body axes of an upright board: forward, left, up.
  [[nodiscard]] Eigen::Vector3d force_mps2(double t) const {
    Eigen::Vector3d force(0.0, 0.0, kGravityMps2);
    for (std::size_t i = 0; i < falls_.size(); ++i) {
      const double since = t - falls_[i].instant_s;
      const double bump = std::exp(-0.5 * std::pow(since / 0.08, 2.0));
      force.z() += falls_[i].bounce_mps2 * bump;
      force.x() +=
          0.7 * falls_[i].bounce_mps2 * std::exp(-0.5 * std::pow((since + 0.1) / 0.08, 2.0));
    }
    force.y() = lateral_mps2(t);
    return force;
  }

 private:
  /// 1.5 m/s^2 to one side while one leg carries, and over to the other within a tenth of a second
  /// after a foot has landed.
  [[nodiscard]] double lateral_mps2(double t) const {
    if (t < falls_.front().instant_s - 0.6 || t > falls_.back().instant_s + 0.6) return 0.0;
    double side = 1.5;
    for (const Footfall& fall : falls_) {
      const double share = (t - fall.instant_s) / 0.1;
      if (share >= 1.0) side = -side;
      if (share > 0.0 && share < 1.0) return side * std::cos(kPi * share);
    }
    return side;
  }

  std::vector<Footfall> falls_;
};

/// So many steps of an ordinary walk.
inline std::vector<Footfall> ordinary_walk(int steps, double first_s = 1.0,
                                           double period_s = 0.55) {
  std::vector<Footfall> falls;
  for (int i = 0; i < steps; ++i) falls.push_back({first_s + period_s * i});
  return falls;
}

/// How a board may hang on a belt.
inline Eigen::Quaterniond askew() { return from_euler({0.4, -1.2, 2.0}); }

}  // namespace vpdr::pdr::made
