#include <algorithm>
#include <cmath>

#include "simulation/building.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

constexpr double kTurnWeight = 2.5;  // a walk with many turns shows more than a straight one
constexpr double kShortestLoopShare = 0.8;

const Vector2d& place(const CorridorNetwork& network, int crossing) {
  return network.crossings_m[static_cast<std::size_t>(crossing)];
}

/// The crossing to walk to from `here`, coming from `before`: never back, rather round a corner.
int draw_next(const CorridorNetwork& network, int before, int here, Random& random) {
  const Vector2d in = (place(network, here) - place(network, before)).normalized();
  const std::vector<int>& choices = network.neighbours[static_cast<std::size_t>(here)];
  const auto weight = [&](int next) {
    if (next == before) return 0.0;
    const Vector2d out = (place(network, next) - place(network, here)).normalized();
    return std::abs(in.dot(out)) < 0.5 ? kTurnWeight : 1.0;
  };
  double total = 0.0;
  for (const int next : choices) total += weight(next);
  double draw = random.uniform(0.0, total);
  for (const int next : choices) {
    draw -= weight(next);
    if (weight(next) > 0.0 && draw <= 0.0) return next;
  }
  return choices.front() == before ? choices.back() : choices.front();
}

/// Corners of a sequence of points without those where the way goes straight on.
Route route_through(const std::vector<Vector2d>& points) {
  Route route;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) route.length_m += (points[i] - points[i - 1]).norm();
    if (i > 0 && i + 1 < points.size()) {
      const Vector2d in = (points[i] - points[i - 1]).normalized();
      const Vector2d out = (points[i + 1] - points[i]).normalized();
      if (in.dot(out) > 0.999) continue;
      ++route.turns;
    }
    route.corners_m.push_back(points[i]);
  }
  return route;
}

Vector2d middle_of_piece(const CorridorNetwork& network, int a, int b) {
  const Vector2d middle = 0.5 * (place(network, a) + place(network, b)) / kTileM;
  return Vector2d(std::round(middle.x()), std::round(middle.y())) * kTileM;
}

}  // namespace

Route draw_route(const CorridorNetwork& network, double length_m, Random& random) {
  const int first = static_cast<int>(random.index(network.crossings_m.size()));
  const auto& choices = network.neighbours[static_cast<std::size_t>(first)];
  int second = choices[random.index(choices.size())];
  const auto climbs = [&](int a, int b) {
    return network.floor_m[static_cast<std::size_t>(a)] !=
           network.floor_m[static_cast<std::size_t>(b)];
  };
  while (climbs(first, second)) second = choices[random.index(choices.size())];
  const Vector2d start = middle_of_piece(network, first, second);
  std::vector<Vector2d> points{start};
  double walked = (place(network, second) - start).norm();
  int before = first, here = second, flights = 0;
  const auto finish = [&](bool closed) {
    Route route = route_through(points);
    route.closed = closed;
    route.flights = flights;
    route.floor_m = network.floor_m[static_cast<std::size_t>(first)];
    return route;
  };
  while (walked < length_m) {
    points.push_back(place(network, here));
    const int next = draw_next(network, before, here, random);
    const double home = walked + (start - place(network, here)).norm();
    if (here == first && next == second && home <= length_m &&
        home > kShortestLoopShare * length_m) {
      points.push_back(start);
      return finish(true);
    }
    walked += (place(network, next) - place(network, here)).norm();
    flights += climbs(here, next) ? 1 : 0;
    before = here;
    here = next;
  }
  const Vector2d back = (place(network, before) - place(network, here)).normalized();
  const Vector2d last = points.back();
  const Vector2d end = place(network, here) + (walked - length_m) * back;
  if ((end - last).norm() > 1.5) points.push_back(end);
  return finish(false);
}

}  // namespace vpdr::simulation
