#include "simulation/building.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

double to_tile(double value) { return std::round(value / kTileM) * kTileM; }

/// Coordinates of parallel corridors.
std::vector<double> draw_lines(int count, const BuildingOptions& options, Random& random) {
  std::vector<double> lines{0.0};
  while (static_cast<int>(lines.size()) < count) {
    lines.push_back(lines.back() +
                    to_tile(random.uniform(options.min_block_m, options.max_block_m)));
  }
  return lines;
}

/// Crossings of `columns` by `rows`, joined to their neighbours on the grid.
CorridorNetwork full_grid(const std::vector<double>& xs, const std::vector<double>& ys) {
  CorridorNetwork network;
  const int columns = static_cast<int>(xs.size()), rows = static_cast<int>(ys.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      network.crossings_m.emplace_back(xs[static_cast<std::size_t>(column)],
                                       ys[static_cast<std::size_t>(row)]);
      std::vector<int> near;
      const int self = row * columns + column;
      if (column > 0) near.push_back(self - 1);
      if (column + 1 < columns) near.push_back(self + 1);
      if (row > 0) near.push_back(self - columns);
      if (row + 1 < rows) near.push_back(self + columns);
      network.neighbours.push_back(near);
      network.floor_m.push_back(0.0);
    }
  }
  return network;
}

std::vector<int>& near(CorridorNetwork& network, int crossing) {
  return network.neighbours[static_cast<std::size_t>(crossing)];
}

bool is_connected(const CorridorNetwork& network) {
  std::vector<char> seen(network.crossings_m.size(), 0);
  std::vector<int> open{0};
  seen[0] = 1;
  while (!open.empty()) {
    const int here = open.back();
    open.pop_back();
    for (const int next : network.neighbours[static_cast<std::size_t>(here)]) {
      if (std::exchange(seen[static_cast<std::size_t>(next)], 1) == 0) open.push_back(next);
    }
  }
  return std::find(seen.begin(), seen.end(), 0) == seen.end();
}

/// Takes pieces of corridor out at random as long as no crossing becomes a dead end or an island.
void leave_out(CorridorNetwork& network, int count, Random& random) {
  for (int attempt = 0; attempt < 20 * count && count > 0; ++attempt) {
    const int a = static_cast<int>(random.index(network.crossings_m.size()));
    const auto pick = random.index(near(network, a).size());
    const int b = near(network, a)[pick];
    if (near(network, a).size() < 3 || near(network, b).size() < 3) continue;
    CorridorNetwork thinned = network;
    std::erase(near(thinned, a), b);
    std::erase(near(thinned, b), a);
    if (!is_connected(thinned)) continue;
    network = std::move(thinned);
    --count;
  }
}

bool joined(const CorridorNetwork& network, int a, int b) {
  const auto& list = network.neighbours[static_cast<std::size_t>(a)];
  return std::find(list.begin(), list.end(), b) != list.end();
}

/// The rectangles of one line of crossings: one for each unbroken run of pieces. `across` holds the
/// half widths of the corridors that cross it.
void add_runs(const CorridorNetwork& network, const std::vector<int>& line, double half_width,
              const std::vector<double>& across, std::vector<Rectangle>& corridors) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i + 1 < line.size() && joined(network, line[i], line[i + 1])) continue;
    if (i > first) {
      const Vector2d from = network.crossings_m[static_cast<std::size_t>(line[first])];
      const Vector2d to = network.crossings_m[static_cast<std::size_t>(line[i])];
      const Vector2d ahead = (to - from).normalized();
      const Vector2d side = half_width * Vector2d(ahead.y(), ahead.x());
      corridors.push_back({from - across[first] * ahead - side, to + across[i] * ahead + side});
    }
    first = i + 1;
  }
}

std::vector<double> draw_half_widths(int count, const BuildingOptions& options, Random& random) {
  std::vector<double> half_widths;
  half_widths.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    half_widths.push_back(0.5 * random.uniform(options.min_width_m, options.max_width_m));
  }
  return half_widths;
}

/// Indices of `count` crossings, `step` apart.
std::vector<int> line_of_crossings(int first, int step, int count) {
  std::vector<int> line(static_cast<std::size_t>(count), first);
  for (int i = 1; i < count; ++i) line[static_cast<std::size_t>(i)] = first + i * step;
  return line;
}

void check(const BuildingOptions& o) {
  if (o.north_south_corridors < 2 || o.east_west_corridors < 2) {
    throw ConfigurationFault("building: needs two corridors each way at least");
  }
  const bool ordered = o.min_width_m > 1.0 && o.max_width_m >= o.min_width_m &&
                       o.min_block_m > o.max_width_m + 1.0 && o.max_block_m >= o.min_block_m;
  if (o.storeys < 1 || o.storeys > 6) {
    throw ConfigurationFault("building: needs one to six storeys");
  }
  if (!ordered || !(o.ceiling_m > 2.2) || !(o.left_out_share >= 0.0 && o.left_out_share < 1.0)) {
    throw ConfigurationFault(
        "building: needs 1 m < min_width <= max_width, blocks wider than a corridor by 1 m, a "
        "ceiling above 2.2 m and a left-out share of 0 to 1");
  }
}

/// One storey at height 0 from (0, 0) on, and how far its outermost corridors reach west and east
/// of their middle lines.
struct Storey {
  CorridorNetwork network;
  std::vector<Rectangle> corridors;
  double west_m = 0.0, east_m = 0.0;
};

Storey draw_storey(const BuildingOptions& options, Random& random) {
  const int columns = options.north_south_corridors, rows = options.east_west_corridors;
  const std::vector<double> xs = draw_lines(columns, options, random);
  const std::vector<double> ys = draw_lines(rows, options, random);
  Storey storey;
  storey.network = full_grid(xs, ys);
  const int pieces = rows * (columns - 1) + columns * (rows - 1);
  leave_out(storey.network, static_cast<int>(options.left_out_share * pieces), random);
  const std::vector<double> half_x = draw_half_widths(columns, options, random);
  const std::vector<double> half_y = draw_half_widths(rows, options, random);
  for (int row = 0; row < rows; ++row) {
    add_runs(storey.network, line_of_crossings(row * columns, 1, columns),
             half_y[static_cast<std::size_t>(row)], half_x, storey.corridors);
  }
  for (int column = 0; column < columns; ++column) {
    add_runs(storey.network, line_of_crossings(column, columns, rows),
             half_x[static_cast<std::size_t>(column)], half_y, storey.corridors);
  }
  storey.west_m = half_x.front();
  storey.east_m = half_x.back();
  return storey;
}

void move(Storey& storey, const Vector2d& by_m, double up_m) {
  for (Vector2d& crossing : storey.network.crossings_m) crossing += by_m;
  for (double& floor : storey.network.floor_m) floor += up_m;
  for (Rectangle& corridor : storey.corridors) {
    corridor.min_m += by_m;
    corridor.max_m += by_m;
    corridor.floor_m += up_m;
  }
}

/// Adds a storey's crossings; the number of the first one.
int append(const CorridorNetwork& storey, CorridorNetwork& network) {
  const int first = static_cast<int>(network.crossings_m.size());
  for (std::size_t i = 0; i < storey.crossings_m.size(); ++i) {
    network.crossings_m.push_back(storey.crossings_m[i]);
    network.floor_m.push_back(storey.floor_m[i]);
    network.neighbours.push_back(storey.neighbours[i]);
    for (int& neighbour : network.neighbours.back()) neighbour += first;
  }
  return first;
}

/// Puts `upper` to the east of `lower`, a storey higher, with a flight of stairs between a crossing
/// of the one's last column and one of the other's first.
void add_storey(const BuildingOptions& options, const Storey& lower, Storey& upper,
                Building& building, Random& random) {
  constexpr double kLandingM = 1.2;
  const int columns = options.north_south_corridors;
  const auto rows = static_cast<std::size_t>(options.east_west_corridors);
  const int from = static_cast<int>(random.index(rows)) * columns + columns - 1;
  const int to = static_cast<int>(random.index(rows)) * columns;
  const Vector2d start = lower.network.crossings_m[static_cast<std::size_t>(from)];
  const double floor = lower.network.floor_m.front();
  const Flight flight{start.x() + lower.east_m + kLandingM, start.y(), floor};
  const double x = std::ceil((flight.head_x_m() + kLandingM + upper.west_m) / kTileM) * kTileM;
  move(upper, Vector2d(x, start.y()) - upper.network.crossings_m[static_cast<std::size_t>(to)],
       floor + Flight::kStoreyM);

  const double half = 0.5 * Flight::kWidthM;
  building.corridors.push_back(
      {{start.x(), start.y() - half}, {flight.foot_x_m, start.y() + half}, floor});
  building.corridors.push_back(
      {{flight.head_x_m(), start.y() - half}, {x, start.y() + half}, floor + Flight::kStoreyM});
  for (const Rectangle& tread : treads_of(flight, options.ceiling_m)) {
    building.corridors.push_back(tread);
  }
  building.flights.push_back(flight);
  const int first_of_lower =
      static_cast<int>(building.network.crossings_m.size() - lower.network.crossings_m.size());
  const int first = append(upper.network, building.network);
  near(building.network, first_of_lower + from).push_back(first + to);
  near(building.network, first + to).push_back(first_of_lower + from);
  building.corridors.insert(building.corridors.end(), upper.corridors.begin(),
                            upper.corridors.end());
}

}  // namespace

Building draw_building(const BuildingOptions& options, Random& random) {
  check(options);
  Storey lower = draw_storey(options, random);
  Building building{lower.network, lower.corridors, {}};
  for (int storey = 1; storey < options.storeys; ++storey) {
    Storey upper = draw_storey(options, random);
    add_storey(options, lower, upper, building, random);
    lower = std::move(upper);
  }
  return building;
}

std::vector<Rectangle> corridors_around(const std::vector<Vector2d>& corners_m, double width_m) {
  const double half = 0.5 * width_m;
  std::vector<Rectangle> corridors;
  Rectangle hall{corners_m.front(), corners_m.front()};
  bool along_axes = true;
  for (std::size_t i = 1; i < corners_m.size(); ++i) {
    const Vector2d& a = corners_m[i - 1];
    const Vector2d& b = corners_m[i];
    const Vector2d leg = (b - a).cwiseAbs();
    along_axes = along_axes && leg.minCoeff() < 0.01 * leg.maxCoeff();
    // A little longer at both ends, so that nobody starts with the face at a wall.
    const Vector2d margin = Vector2d::Constant(half);
    corridors.push_back({a.cwiseMin(b) - margin, a.cwiseMax(b) + margin});
    hall = {hall.min_m.cwiseMin(b), hall.max_m.cwiseMax(b)};
  }
  if (along_axes) return corridors;
  const Vector2d margin = Vector2d::Constant(width_m);
  return {{hall.min_m - margin, hall.max_m + margin}};
}

}  // namespace vpdr::simulation
