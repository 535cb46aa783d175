#pragma once
// People who come towards the walker and pass close by, or cross in front. World ENU, metres. They
// walk straight on and through walls, behind which nobody sees them. Thread-safe once made.
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/time.hpp"
#include "simulation/random.hpp"
#include "simulation/render/shot.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

class PassersBy {
 public:
  /// `per_min` people a minute of what is filmed, on the average, drawn from the seed.
  PassersBy(const Shot& shot, double per_min);

  /// The bodies of those near the walker at an instant.
  [[nodiscard]] std::vector<Solid> at(TimestampNs stamp_ns) const;

 private:
  struct Person {
    TimestampNs meets_ns;     ///< when it is where it comes closest
    Eigen::Vector3d place_m;  ///< of the feet then
    Eigen::Vector2d velocity_mps;
    double height_m;
    double shirt, trousers, hair;  ///< shades
    double phase;                  ///< of its steps
  };

  [[nodiscard]] static Person draw(const Shot& shot, TimestampNs stamp_ns, Random& random);
  static void add_body(const Person& person, double since_s, std::vector<Solid>& bodies);

  std::vector<Person> people_;
};

}  // namespace vpdr::simulation
