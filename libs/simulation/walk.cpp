#include "simulation/walk.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void require(bool good, const std::string& what) {
  if (!good) throw ConfigurationFault("simulate: " + what);
}

void check(const WalkOptions& o) {
  const auto rate = [](double hz) { return hz >= 0.0 && hz <= 2000.0; };
  require(o.duration_s >= 5.0 && o.duration_s <= 86400.0, "duration_s must be 5 to 86400");
  require(o.imu_rate_hz >= 5.0 && rate(o.imu_rate_hz), "imu_rate_hz must be 5 to 2000");
  require(rate(o.mag_rate_hz), "mag_rate_hz must be 0 (none) to 2000");
  require(rate(o.pressure_rate_hz), "pressure_rate_hz must be 0 (none) to 2000");
  require(rate(o.camera_rate_hz), "camera_rate_hz must be 0 (none) to 2000");
  require(o.stamp_jitter_s >= 0.0 && o.stamp_jitter_s < 0.1 / o.imu_rate_hz,
          "stamp_jitter_s must be 0 to a tenth of the IMU's period");
  require(o.corridor_width_m >= 1.2, "corridor_width_m must be 1.2 at least");
  require(o.turn_length_m > 0.1, "turn_length_m must be above 0.1");
  require(o.pauses.initial_s >= 0.5, "pauses.initial_s must be 0.5 at least");
  require(o.pauses.final_s >= 0.5, "pauses.final_s must be 0.5 at least");
  const Walker& w = o.walker;
  require(w.height_m > 1.0 && w.height_m < 2.3, "walker.height_m must be 1.0 to 2.3");
  require(w.preferred_speed_mps >= 0.3 && w.preferred_speed_mps <= 2.2,
          "walker.preferred_speed_mps must be 0.3 to 2.2");
  require(w.walk_ratio_m_per_spm >= 0.003 && w.walk_ratio_m_per_spm <= 0.012,
          "walker.walk_ratio_m_per_spm must be 0.003 to 0.012");
}

/// The way, the corridors around it, and the steps along it.
struct Course {
  std::vector<Vector2d> corners_m;
  std::vector<Rectangle> corridors;
  Ground ground;
};

Course given_course(const WalkOptions& options) {
  return {options.waypoints_m, corridors_around(options.waypoints_m, options.corridor_width_m),
          Ground()};
}

/// How well a route shows the system at work, before it is walked: it comes home, turns about every
/// 13 m, does not take the same corner twice, climbs where there are stairs, and takes about the
/// time there is.
double promise(const Route& route, const WalkOptions& o) {
  constexpr double kFlightS = 8.0;  // more than as much way on the level
  const double walking_s =
      route.length_m / o.walker.preferred_speed_mps + 0.9 * route.turns + kFlightS * route.flights;
  const double stops = o.pauses.stop_every_s > 0.0 ? walking_s / o.pauses.stop_every_s : 0.0;
  const double spare_s = o.duration_s - o.pauses.initial_s - o.pauses.final_s - 1.0 - walking_s -
                         stops * (o.pauses.stop_s + 2.0);
  double repeated = 0.0;
  for (std::size_t i = 1; i + 1 < route.corners_m.size(); ++i) {
    for (std::size_t k = 1; k < i; ++k) {
      if ((route.corners_m[i] - route.corners_m[k]).norm() < 0.1) repeated += 1.0;
    }
  }
  // The first flight is worth more than coming home.
  const double climbed = route.flights > 0 ? 12.0 + 4.0 * std::min(route.flights, 2) : 0.0;
  return (route.closed ? 10.0 : 0.0) + climbed - std::abs(route.turns - route.length_m / 13.0) -
         2.5 * repeated - (spare_s < 0.0 ? -1.5 : 0.3) * spare_s;
}

/// The same after the walk on trial: whether it comes home in time, and how much time it leaves.
double merit(const Route& route, const GaitPlan& gait, const WalkOptions& o) {
  const double spare_s = o.duration_s - o.pauses.final_s - gait.end_of_walk_s;
  return promise(route, o) + (gait.reached_end ? 10.0 : 0.0) - 0.5 * spare_s;
}

/// Random routes, the most promising first.
std::vector<Route> promising_routes(const CorridorNetwork& network, const WalkOptions& o,
                                    Random& random, std::size_t count) {
  constexpr int kDraws = 40000;
  const double walking_s = o.duration_s - o.pauses.initial_s - o.pauses.final_s;
  const double reach_m = std::max(4.0, walking_s * o.walker.preferred_speed_mps);
  std::vector<std::pair<double, Route>> routes;
  for (int i = 0; i < kDraws; ++i) {
    Route route = draw_route(network, reach_m * random.uniform(0.8, 1.0), random);
    if (!route.closed && route.flights == 0 && i >= 50) continue;
    const double value = promise(route, o);
    routes.emplace_back(value, std::move(route));
  }
  std::stable_sort(routes.begin(), routes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Route> best;
  for (std::size_t i = 0; i < std::min(count, routes.size()); ++i) {
    best.push_back(std::move(routes[i].second));
  }
  return best;
}

/// The building moved so that a route through it begins at (0, 0) on a floor at z = 0.
Course moved_to_start(const Building& building, const Route& route) {
  const Vector2d start = route.corners_m.front();
  std::vector<Flight> flights = building.flights;
  for (Flight& flight : flights) {
    flight.foot_x_m -= start.x();
    flight.y_m -= start.y();
    flight.low_m -= route.floor_m;
  }
  Course course{route.corners_m, building.corridors, Ground(std::move(flights), -route.floor_m)};
  for (Vector2d& corner : course.corners_m) corner -= start;
  for (Rectangle& r : course.corridors) {
    r.min_m -= start;
    r.max_m -= start;
    r.floor_m -= route.floor_m;
  }
  return course;
}

/// The best of many random routes through a building drawn from the seed, moved to begin at (0, 0).
Course drawn_course(const WalkOptions& o) {
  constexpr std::size_t kWalkedOnTrial = 24;
  Random random(o.seed, "building");
  const Building building = draw_building(o.building, random);
  std::vector<Route> routes = promising_routes(building.network, o, random, kWalkedOnTrial);
  const Ground ground(building.flights);
  const auto value = [&](const Route& route) {
    const WalkingPath path(route.corners_m, o.turn_length_m);
    return merit(route,
                 plan_gait(path, ground, o.walker, o.pauses, o.duration_s, Random(o.seed, "gait")),
                 o);
  };
  std::size_t best = 0;
  double best_value = value(routes[0]);
  for (std::size_t i = 1; i < routes.size(); ++i) {
    const double candidate = value(routes[i]);
    if (candidate <= best_value) continue;
    best = i;
    best_value = candidate;
  }
  return moved_to_start(building, routes[best]);
}

/// Sampling instants of one sensor.
std::vector<TimestampNs> sampling_instants(const WalkOptions& options, double rate_hz,
                                           Random random) {
  std::vector<TimestampNs> stamps;
  if (!(rate_hz > 0.0)) return stamps;
  const auto count = static_cast<std::int64_t>(std::floor(options.duration_s * rate_hz));
  for (std::int64_t k = 0; k < count; ++k) {
    const double jitter = std::clamp(random.normal(), -3.0, 3.0) * options.stamp_jitter_s;
    const double t = static_cast<double>(k) / rate_hz + (k > 0 ? jitter : 0.0);
    stamps.push_back(options.start_ns + to_ns(t));
  }
  return stamps;
}

void sample_imu(SimulatedWalk& walk) {
  const WalkOptions& o = walk.options;
  TriadSensor accelerometer(o.errors.accelerometer, o.imu_rate_hz, Random(o.seed, "acc"));
  TriadSensor gyroscope(o.errors.gyroscope, o.imu_rate_hz, Random(o.seed, "gyro"));
  for (const TimestampNs stamp : sampling_instants(o, o.imu_rate_hz, Random(o.seed, "imu time"))) {
    const MotionState state = walk.state_at(stamp);
    const double interval = walk.imu.empty() ? 0.0 : to_seconds(stamp - walk.imu.back().stamp_ns);
    ImuSample sample;
    sample.stamp_ns = stamp;
    sample.specific_force_mps2 = accelerometer.read(state.specific_force_mps2(), interval);
    sample.angular_velocity_radps = gyroscope.read(state.angular_velocity_radps, interval);
    walk.imu.push_back(sample);
  }
}

void sample_field(SimulatedWalk& walk) {
  const WalkOptions& o = walk.options;
  const MagneticField field(o.field, walk.plan, Random(o.seed, "field"));
  TriadSensor magnetometer(o.errors.magnetometer, o.mag_rate_hz, Random(o.seed, "mag"));
  for (const TimestampNs stamp : sampling_instants(o, o.mag_rate_hz, Random(o.seed, "mag time"))) {
    const MotionState state = walk.state_at(stamp);
    const double interval = walk.mag.empty() ? 0.0 : to_seconds(stamp - walk.mag.back().stamp_ns);
    // Storeys lie beside one another, each with its steel at the height of its own walls.
    Vector3d place = state.position_m;
    place.z() -= walk.ground.at(place.head<2>());
    const Vector3d truth = state.world_from_body.conjugate() * field.at(place);
    walk.mag.push_back({stamp, magnetometer.read(truth, interval)});
  }
}

void sample_pressure(SimulatedWalk& walk) {
  const WalkOptions& o = walk.options;
  Barometer barometer(o.errors, Random(o.seed, "baro"));
  for (const TimestampNs stamp :
       sampling_instants(o, o.pressure_rate_hz, Random(o.seed, "baro time"))) {
    const double interval =
        walk.pressure.empty() ? 0.0 : to_seconds(stamp - walk.pressure.back().stamp_ns);
    walk.pressure.push_back({stamp, barometer.read(walk.state_at(stamp).position_m.z(), interval)});
  }
}

}  // namespace

MotionState SimulatedWalk::state_at(TimestampNs stamp_ns) const {
  return motion.at(to_seconds(stamp_ns - options.start_ns));
}

Eigen::Isometry3d SimulatedWalk::world_from_camera(TimestampNs stamp_ns) const {
  const MotionState state = state_at(stamp_ns);
  Eigen::Isometry3d world_from_body = Eigen::Isometry3d::Identity();
  world_from_body.linear() = state.world_from_body.toRotationMatrix();
  world_from_body.translation() = state.position_m;
  return world_from_body * options.camera.body_from_camera;
}

SimulatedWalk simulate_walk(const WalkOptions& asked) {
  WalkOptions o = asked;
  if (o.draw_walker) {
    Random random(o.seed, "walker");
    o.walker = draw_walker(random);
  }
  check(o);
  Course course = o.waypoints_m.empty() ? drawn_course(o) : given_course(o);
  const WalkingPath path(course.corners_m, o.turn_length_m);
  const GaitPlan gait =
      plan_gait(path, course.ground, o.walker, o.pauses, o.duration_s, Random(o.seed, "gait"));
  SimulatedWalk walk{.options = o,
                     .plan = FloorPlan(std::move(course.corridors), o.building.ceiling_m),
                     .ground = course.ground,
                     .motion = move_board(path, course.ground, gait, o.walker, o.worn, o.duration_s,
                                          Random(o.seed, "body")),
                     .corners_m = std::move(course.corners_m),
                     .steps = true_steps(gait, o.start_ns)};
  for (const TrueStep& step : walk.steps) walk.distance_m += step.length_m;
  sample_imu(walk);
  sample_field(walk);
  sample_pressure(walk);
  Random camera_time(o.seed, "camera time");
  walk.frames = sampling_instants(o, o.camera_rate_hz, camera_time);
  return walk;
}

}  // namespace vpdr::simulation
