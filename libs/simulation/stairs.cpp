#include "simulation/stairs.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::simulation {
namespace {

constexpr double kRoundingM = 0.4;  // of the way before and after the ramp's ends

/// max(0, x), rounded where it bends.
double rounded_ramp(double x) {
  if (x <= -kRoundingM) return 0.0;
  if (x >= kRoundingM) return x;
  return (x + kRoundingM) * (x + kRoundingM) / (4.0 * kRoundingM);
}

}  // namespace

std::vector<Rectangle> treads_of(const Flight& flight, double ceiling_m) {
  std::vector<Rectangle> treads;
  const double top = flight.low_m + Flight::kStoreyM + ceiling_m;
  const double half = 0.5 * Flight::kWidthM;
  for (int k = 0; k + 1 < Flight::kRisers; ++k) {
    const double x = flight.foot_x_m + k * Flight::kGoingM;
    const double floor = flight.low_m + (k + 1) * Flight::kRiserM;
    treads.push_back(
        {{x, flight.y_m - half}, {x + Flight::kGoingM, flight.y_m + half}, floor, top - floor});
  }
  return treads;
}

double Ground::at(const Eigen::Vector2d& place_m) const {
  double height = floor_m_;
  for (const Flight& flight : flights_) {
    // The mean height of the treads: half a riser up at the first riser.
    const double from = flight.foot_x_m - 0.5 * Flight::kGoingM;
    const double to = flight.head_x_m() + 0.5 * Flight::kGoingM;
    height += Flight::kRiserM / Flight::kGoingM *
              (rounded_ramp(place_m.x() - from) - rounded_ramp(place_m.x() - to));
  }
  return height;
}

bool Ground::is_stairs(const Eigen::Vector2d& place_m) const {
  return std::any_of(flights_.begin(), flights_.end(), [&](const Flight& flight) {
    return place_m.x() > flight.foot_x_m - Flight::kGoingM && place_m.x() < flight.head_x_m() &&
           std::abs(place_m.y() - flight.y_m) < 0.5 * Flight::kWidthM;
  });
}

}  // namespace vpdr::simulation
