#include "simulation/render/room_around.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "core/rotation.hpp"
#include "simulation/building.hpp"
#include "simulation/random.hpp"
#include "simulation/render/furniture.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHandHeightM = 1.3;
constexpr double kHeadroomM = 0.8;
constexpr double kClimbM = 2.0;  // more height than that is a staircase
constexpr double kCorridorCellM = 1.2;
constexpr double kBesideM = 0.9;  // of free floor on both sides of the path

struct Box {
  Vector3d low, high;
};

Box bounds_of(const std::vector<Vector3d>& points) {
  Box box{points.front(), points.front()};
  for (const Vector3d& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

std::vector<Vector3d> turned(const ReferencePath& path, double yaw_rad) {
  const Eigen::AngleAxisd turn(-yaw_rad, Vector3d::UnitZ());
  std::vector<Vector3d> points;
  points.reserve(path.poses().size());
  for (const PathPose& pose : path.poses()) points.push_back(turn * pose.position_m);
  return points;
}

/// The direction, to a quarter turn, in which most of the way goes: the phase of the fourth
/// harmonic.
double main_direction(const ReferencePath& path) {
  Vector2d sum = Vector2d::Zero();
  Vector2d last = path.poses().front().position_m.head<2>();
  for (const PathPose& pose : path.poses()) {
    const Vector2d leg = pose.position_m.head<2>() - last;
    if (leg.norm() < 0.3) continue;  // what the hand does between is not the way
    const double angle = 4.0 * std::atan2(leg.y(), leg.x());
    sum += leg.norm() * Vector2d(std::cos(angle), std::sin(angle));
    last = pose.position_m.head<2>();
  }
  return sum.norm() > 0.0 ? 0.25 * std::atan2(sum.y(), sum.x()) : 0.0;
}

double floor_below(const Box& box) {
  constexpr double kLowestM = 0.3, kHighestM = 1.9;
  const bool stands_on_zero = box.low.z() > kLowestM && box.low.z() < kHighestM;
  return stands_on_zero ? 0.0 : box.low.z() - kHandHeightM;
}

double to_grid(double value, double direction, double grid_m) {
  return direction < 0.0 ? std::floor(value / grid_m) * grid_m : std::ceil(value / grid_m) * grid_m;
}

/// One free rectangle for each unbroken row of cells near the path.
std::vector<Rectangle> corridors_along(const std::vector<Vector3d>& points, double floor_m,
                                       double height_m) {
  std::set<std::pair<int, int>> cells;  // row, column
  const auto index = [](double value) {
    return static_cast<int>(std::floor(value / kCorridorCellM));
  };
  for (const Vector3d& p : points) {
    for (int row = index(p.y() - kBesideM); row <= index(p.y() + kBesideM); ++row) {
      for (int column = index(p.x() - kBesideM); column <= index(p.x() + kBesideM); ++column) {
        cells.insert({row, column});
      }
    }
  }
  std::vector<Rectangle> corridors;
  for (auto cell = cells.begin(); cell != cells.end();) {
    const auto [row, first] = *cell;
    int last = first;
    for (++cell; cell != cells.end() && *cell == std::pair(row, last + 1); ++cell) ++last;
    corridors.push_back({{first * kCorridorCellM, row * kCorridorCellM},
                         {(last + 1) * kCorridorCellM, (row + 1) * kCorridorCellM},
                         floor_m,
                         height_m});
  }
  return corridors;
}

}  // namespace

Eigen::Isometry3d Surroundings::from_world() const {
  return Eigen::Isometry3d(Eigen::AngleAxisd(-yaw_rad, Vector3d::UnitZ()));
}

Surroundings surround(const ReferencePath& path, const RoomOptions& options) {
  const Box in_world = bounds_of(turned(path, 0.0));
  const bool is_room =
      (in_world.high - in_world.low).head<2>().maxCoeff() <= options.largest_room_m;
  const double yaw = is_room ? 0.0 : main_direction(path);
  const std::vector<Vector3d> points = turned(path, yaw);
  const Box box = bounds_of(points);
  const double floor = floor_below(box);
  const double height = std::max(options.ceiling_m, box.high.z() + kHeadroomM - floor);
  if (!is_room && box.high.z() - box.low.z() <= kClimbM) {
    return {FloorPlan(corridors_along(points, floor, height), options.ceiling_m), {}, yaw};
  }
  Rectangle room{{0.0, 0.0}, {0.0, 0.0}, floor, height};
  for (const int axis : {0, 1}) {
    room.min_m[axis] = to_grid(box.low[axis] - options.margin_m, -1.0, 0.1);
    room.max_m[axis] = to_grid(box.high[axis] + options.margin_m, 1.0, 0.1);
  }
  Random random(options.seed, "furniture");
  std::vector<Vector2d> way;
  for (const Vector3d& p : points) way.push_back(p.head<2>());
  return {FloorPlan({room}, options.ceiling_m),
          draw_furniture(room, way, options.furniture_share, random), yaw};
}

Shot shot_in(const Surroundings& place, const ReferencePath& path, const Camera& camera,
             std::uint64_t seed, std::vector<TimestampNs> frames) {
  Shot shot{.plan = place.plan,
            .furniture = place.furniture,
            .camera = camera,
            .seed = seed,
            .frames = std::move(frames),
            .world_from_camera = {}};
  shot.world_from_camera = [path = std::make_shared<const ReferencePath>(path),
                            from_world = place.from_world(), mount = camera.body_from_camera](
                               TimestampNs stamp) { return from_world * path->at(stamp) * mount; };
  return shot;
}

}  // namespace vpdr::simulation
