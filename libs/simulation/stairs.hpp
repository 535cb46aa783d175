#pragma once
// Flights of stairs that lead up eastwards from one storey of a building to the next, and the
// height at which they carry a walker. World ENU, metres.
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "simulation/floor_plan.hpp"

namespace vpdr::simulation {

/// A straight flight. A storey lies wholly to the west of the flight that leads up from it.
struct Flight {
  static constexpr int kRisers = 18;
  static constexpr double kRiserM = 1.0 / 6.0;
  static constexpr double kGoingM = 0.3;  ///< depth of a tread
  static constexpr double kWidthM = 2.0;
  static constexpr double kStoreyM = kRisers * kRiserM;

  double foot_x_m = 0.0;  ///< of the first riser
  double y_m = 0.0;       ///< of its middle line
  double low_m = 0.0;     ///< the floor from which it leads up

  /// Of the last riser.
  [[nodiscard]] double head_x_m() const { return foot_x_m + (kRisers - 1) * kGoingM; }
};

/// Its treads; all have their ceiling `ceiling_m` above the upper floor.
std::vector<Rectangle> treads_of(const Flight& flight, double ceiling_m);

/// The ground as a walker's body feels it: level on a storey, a ramp with rounded ends along a
/// flight. Thread-safe once made.
class Ground {
 public:
  Ground() = default;
  /// `floor_m`: of the storey that lies farthest west.
  explicit Ground(std::vector<Flight> flights, double floor_m = 0.0)
      : flights_(std::move(flights)), floor_m_(floor_m) {}

  [[nodiscard]] double at(const Eigen::Vector2d& place_m) const;
  /// True where a foot stands on a tread.
  [[nodiscard]] bool is_stairs(const Eigen::Vector2d& place_m) const;
  [[nodiscard]] const std::vector<Flight>& flights() const { return flights_; }

 private:
  std::vector<Flight> flights_;
  double floor_m_ = 0.0;
};

}  // namespace vpdr::simulation
