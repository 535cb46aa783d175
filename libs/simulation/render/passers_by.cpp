#include "simulation/render/passers_by.hpp"

#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBeforeS = 7.0;  // how long before and after the meeting somebody is there
constexpr double kAfterS = 4.0;
constexpr double kCrossShare = 0.35;

/// Where the walker goes, or looks where it stands.
Vector2d heading_at(const Shot& shot, TimestampNs stamp_ns) {
  const Vector3d before = shot.world_from_camera(stamp_ns - kNsPerSecond / 2).translation();
  const Vector3d after = shot.world_from_camera(stamp_ns + kNsPerSecond / 2).translation();
  const Vector2d way = (after - before).head<2>();
  if (way.norm() > 0.2) return way.normalized();
  const Vector2d look = shot.world_from_camera(stamp_ns).linear().col(2).head<2>();
  return look.norm() > 0.1 ? Vector2d(look.normalized()) : Vector2d::UnitX();
}

double floor_under(const FloorPlan& plan, const Vector3d& place_m) {
  const int cell = plan.cell_at(place_m.head<2>());
  return cell >= 0 ? plan.cell(cell).floor_m : place_m.z() - 1.6;
}

}  // namespace

PassersBy::PassersBy(const Shot& shot, double per_min) {
  if (!(per_min > 0.0) || shot.frames.empty()) return;
  Random random(shot.seed, "passers-by");
  const double mean_s = 60.0 / per_min;
  TimestampNs stamp = shot.frames.front();
  while (true) {
    stamp += to_ns(mean_s * random.uniform(0.5, 1.5));
    if (stamp > shot.frames.back()) return;
    people_.push_back(draw(shot, stamp, random));
  }
}

PassersBy::Person PassersBy::draw(const Shot& shot, TimestampNs stamp_ns, Random& random) {
  const Vector3d eye = shot.world_from_camera(stamp_ns).translation();
  const Vector2d ahead = heading_at(shot, stamp_ns), left(-ahead.y(), ahead.x());
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  Person person{};
  person.meets_ns = stamp_ns;
  person.place_m = {0.0, 0.0, floor_under(shot.plan, eye)};
  if (random.chance(kCrossShare)) {
    person.place_m.head<2>() = eye.head<2>() + random.uniform(2.2, 3.5) * ahead;
    person.velocity_mps = side * random.uniform(1.1, 1.6) * left;
  } else {
    person.place_m.head<2>() = eye.head<2>() + side * random.uniform(0.55, 0.8) * left;
    person.velocity_mps = -random.uniform(1.0, 1.5) * ahead;
  }
  person.height_m = 1.72 + random.normal(0.09);
  person.shirt = random.uniform(0.1, 0.8);
  person.trousers = random.uniform(0.05, 0.4);
  person.hair = random.uniform(0.05, 0.5);
  person.phase = random.uniform(0.0, 2.0 * kPi);
  return person;
}

std::vector<Solid> PassersBy::at(TimestampNs stamp_ns) const {
  std::vector<Solid> bodies;
  for (const Person& person : people_) {
    const double since_s = to_seconds(stamp_ns - person.meets_ns);
    if (since_s > -kBeforeS && since_s < kAfterS) add_body(person, since_s, bodies);
  }
  return bodies;
}

void PassersBy::add_body(const Person& person, double since_s, std::vector<Solid>& bodies) {
  const double speed = person.velocity_mps.norm();
  const double yaw = std::atan2(person.velocity_mps.y(), person.velocity_mps.x());
  const Vector2d ahead = person.velocity_mps / speed, left(-ahead.y(), ahead.x());
  const Vector2d middle = person.place_m.head<2>() + since_s * person.velocity_mps;
  const double size = person.height_m / 1.72;
  // Two steps, 1.4 m, a cycle: the legs swing against each other, each arm with the other leg.
  const double swing = std::sin(person.phase + 2.0 * kPi * speed * since_s / 1.4);
  const auto add = [&](double forward, double aside, double up, const Vector3d& box, double shade) {
    Solid solid;
    const Vector2d at = middle + size * (forward * ahead + aside * left);
    solid.foot_m = Vector3d(at.x(), at.y(), person.place_m.z() + size * up).cast<float>();
    solid.size_m = (size * box).cast<float>();
    solid.yaw_rad = static_cast<float>(yaw);
    solid.shade = static_cast<float>(shade);
    bodies.push_back(std::move(solid));
  };
  add(0.20 * swing, 0.09, 0.0, {0.15, 0.14, 0.84}, person.trousers);
  add(-0.20 * swing, -0.09, 0.0, {0.15, 0.14, 0.84}, person.trousers);
  add(-0.16 * swing, 0.27, 0.80, {0.10, 0.09, 0.62}, 0.8 * person.shirt);
  add(0.16 * swing, -0.27, 0.80, {0.10, 0.09, 0.62}, 0.8 * person.shirt);
  add(0.0, 0.0, 1.44, {0.10, 0.10, 0.08}, 0.6);
  add(0.0, 0.0, 1.51, {0.20, 0.16, 0.21}, 0.62);
  add(-0.02, 0.0, 1.66, {0.20, 0.17, 0.06}, person.hair);
  add(0.0, 0.0, 0.82, {0.22, 0.42, 0.63}, person.shirt);
  const auto shirt = static_cast<float>(person.shirt);
  const auto width = static_cast<float>(size * 0.42), top = static_cast<float>(size * 0.63);
  // Collar, zip and a print on breast and back.
  bodies.back().faces[0] = {{{0.49F * width, 0.51F * width}, {0.0F, top}, 0.4F * shirt},
                            {{0.25F * width, 0.45F * width}, {0.55F * top, 0.75F * top}, 0.9F},
                            {{0.35F * width, 0.65F * width}, {0.93F * top, top}, 0.85F}};
}

}  // namespace vpdr::simulation
