#include "simulation/render/pixel_shader.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/building.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kTile = static_cast<float>(kTileM);
constexpr float kSmallestFootprintM = 2e-4F;
constexpr int kFirstWall = 2;  // surface numbers: floor, ceiling, walls, steps, faces of solids

/// Darkening towards an edge where two surfaces meet.
float edge_shadow(float distance, float depth, float reach) {
  const float relative = distance / reach;
  return 1.0F - depth / (1.0F + relative * relative);
}

/// Distance to the nearer wall on each axis.
Vector2f edge_distance(const Cell& cell, const Vector3f& place) {
  return {std::min(place.x() - cell.west_m, cell.east_m - place.x()),
          std::min(place.y() - cell.south_m, cell.north_m - place.y())};
}

float painted(float shade, const std::vector<Patch>& patches, const Footprint& u,
              const Footprint& v) {
  for (const Patch& patch : patches) {
    const float share = coverage(v, patch.up);
    if (share > 0.0F) shade = mix(shade, patch.shade, share * coverage(u, patch.along));
  }
  return shade;
}

}  // namespace

float PixelShader::footprint(const Ray& ray, float distance, int axis, int normal_axis) {
  // A point on the plane moves with the ray and, along the ray, so that it stays on the plane.
  const float slope = ray.direction[axis] / ray.direction[normal_axis];
  const float by_x = ray.step_x[axis] - slope * ray.step_x[normal_axis];
  const float by_y = ray.step_y[axis] - slope * ray.step_y[normal_axis];
  return std::max(distance * (std::abs(by_x) + std::abs(by_y)), kSmallestFootprintM);
}

PixelShader::Nearest PixelShader::nearest(const View& view, const Vector3f& direction,
                                          Candidates candidates, float limit) {
  Nearest hit;
  for (const std::uint16_t i : candidates) {
    const SolidInView& solid = view.solids[i];
    const SolidInView::Entry entry = solid.enter(solid.turned(direction));
    if (entry.distance > 0.0F && entry.distance < limit) {
      limit = entry.distance;
      hit = {i, entry};
    }
  }
  return hit;
}

float PixelShader::distance(const View& view, const Vector3f& direction,
                            Candidates candidates) const {
  const Sight sight = scene_.plan().follow(view.cell, view.eye_m, direction);
  const Nearest hit = nearest(view, direction, candidates, sight.distance);
  return hit.solid >= 0 ? hit.entry.distance : sight.distance;
}

Shaded PixelShader::shade(const View& view, const Ray& ray, Candidates candidates) const {
  const Sight sight = scene_.plan().follow(view.cell, view.eye_m, ray.direction);
  const int first_step = kFirstWall + static_cast<int>(scene_.plan().walls().size());
  if (!candidates.empty()) {
    const Nearest hit = nearest(view, ray.direction, candidates, sight.distance);
    if (hit.solid >= 0) {
      const int first = first_step + static_cast<int>(scene_.plan().openings().size());
      return {solid(view, ray, hit), first + 3 * hit.solid + hit.entry.axis};
    }
  }
  switch (sight.kind) {
    case Sight::Kind::kWall:
      return {wall(view, ray, sight), kFirstWall + sight.index};
    case Sight::Kind::kStep:
      return {step(view, ray, sight), first_step + sight.index};
    case Sight::Kind::kFloor:
      return {floor(view, ray, sight), 0};
    default:
      return {ceiling(view, ray, sight), 1};
  }
}

float PixelShader::wall(const View& view, const Ray& ray, const Sight& sight) const {
  const auto index = static_cast<std::size_t>(sight.index);
  const Wall& geometry = scene_.plan().walls()[index];
  const WallFace& face = scene_.faces()[index];
  const int normal_axis = std::abs(geometry.normal.x()) > 0.5 ? 0 : 1;
  const int axis = 1 - normal_axis;
  const Vector3f place = view.eye_m + sight.distance * ray.direction;
  const float along = std::abs(place[axis] - static_cast<float>(geometry.start_m[axis]));
  const float up = place.z() - static_cast<float>(geometry.floor_m);
  const float width = footprint(ray, sight.distance, axis, normal_axis);
  const float tall = footprint(ray, sight.distance, 2, normal_axis);
  const Footprint u(along, width), v(up, tall);

  float shade = face.paint;
  for (const Patch& band : face.bands) shade = mix(shade, band.shade, coverage(v, band.up));
  const WallRow& row = face.row_at(up);
  const auto bucket = static_cast<std::size_t>(std::max(0.0F, u.low * 2.0F));
  for (auto i = static_cast<std::size_t>(
           row.first_object[std::min(bucket, row.first_object.size() - 1)]);
       i < row.objects.size() && row.objects[i].along.low < u.high; ++i) {
    shade = painted(shade, row.objects[i].patches, u, v);
  }
  shade += 0.022F * scene_.noise().at(along + face.texture_m, place.z(), std::max(width, tall));

  const auto height = static_cast<float>(geometry.height_m);
  float light =
      face.facing * edge_shadow(up, 0.30F, 0.10F) * edge_shadow(height - up, 0.22F, 0.20F);
  if (face.corner_left) light *= edge_shadow(along, 0.25F, 0.15F);
  if (face.corner_right) light *= edge_shadow(face.length_m - along, 0.25F, 0.15F);
  const Vector2f before = place.head<2>() + 0.15F * geometry.normal.cast<float>();
  return shade * light * scene_.light().at(before.x(), before.y());
}

/// The riser of a step with a dark nosing along its upper edge, or a plain lintel.
float PixelShader::step(const View& view, const Ray& ray, const Sight& sight) const {
  const Opening& opening = scene_.plan().openings()[static_cast<std::size_t>(sight.index)];
  const Vector3f place = view.eye_m + sight.distance * ray.direction;
  const float width = footprint(ray, sight.distance, 1 - opening.axis, opening.axis);
  const float tall = footprint(ray, sight.distance, 2, opening.axis);
  const float below = static_cast<float>(opening.low_m) - place.z();
  constexpr Interval kNosing{-0.01F, 0.035F};
  float shade = below > 0.0F ? mix(0.55F, 0.12F, coverage(Footprint(below, tall), kNosing)) : 0.78F;
  shade += 0.03F * scene_.noise().at(place[1 - opening.axis], place.z(), std::max(width, tall));
  return 0.9F * shade * scene_.light().at(place.x(), place.y());
}

float PixelShader::floor(const View& view, const Ray& ray, const Sight& sight) const {
  const Vector3f place = view.eye_m + sight.distance * ray.direction;
  const float width = footprint(ray, sight.distance, 0, 2);
  const float depth = footprint(ray, sight.distance, 1, 2);
  const Footprint x(place.x(), width), y(place.y(), depth);
  const Vector2f edge = edge_distance(scene_.plan().cell(sight.cell), place);

  float shade = 0.47F + scene_.floor_tiles().average(x, y);
  shade += 0.035F * scene_.noise().at(place.x(), place.y(), std::max(width, depth));
  constexpr float kOffset = Scene::kTileOffsetM;
  shade = mix(shade, 0.30F, line_coverage(x, kOffset, kTile, 0.005F));
  shade = mix(shade, 0.30F, line_coverage(y, kOffset, kTile, 0.005F));
  constexpr Interval kBorder{-1.0F, 0.14F};  // a dark strip along the walls
  const float border = std::max(coverage(Footprint(edge.x(), width), kBorder),
                                coverage(Footprint(edge.y(), depth), kBorder));
  shade = mix(shade, 0.24F, border);
  const float light = edge_shadow(edge.x(), 0.30F, 0.12F) * edge_shadow(edge.y(), 0.30F, 0.12F);
  return shade * light * scene_.light().at(place.x(), place.y()) +
         lamp_in_floor(view, ray, place, sight.cell, x, y);
}

/// The lamps' image in the polished floor: their ray goes on upwards as if mirrored.
float PixelShader::lamp_in_floor(const View& view, const Ray& ray, const Vector3f& place, int cell,
                                 const Footprint& x, const Footprint& y) const {
  const Vector3f& d = ray.direction;
  const Sight on = scene_.plan().follow(cell, place, {d.x(), d.y(), -d.z()});
  if (on.kind != Sight::Kind::kCeiling) return 0.0F;
  const Vector2f lamp = place.head<2>() + on.distance * d.head<2>();
  const float height = -on.distance * d.z();
  const float spread = 1.0F + height / (view.eye_m.z() - place.z());
  constexpr float kBlurM = 0.25F;
  const float share = scene_.lamps().average(Footprint(lamp.x(), x.width() * spread + kBlurM),
                                             Footprint(lamp.y(), y.width() * spread + kBlurM));
  if (share <= 0.0F) return 0.0F;
  const float grazing = 1.0F + d.z() / d.norm();
  return (0.08F + 0.35F * grazing * grazing) * share;
}

float PixelShader::ceiling(const View& view, const Ray& ray, const Sight& sight) const {
  const Vector3f place = view.eye_m + sight.distance * ray.direction;
  const float width = footprint(ray, sight.distance, 0, 2);
  const float depth = footprint(ray, sight.distance, 1, 2);
  const Footprint x(place.x(), width), y(place.y(), depth);
  const Vector2f edge = edge_distance(scene_.plan().cell(sight.cell), place);

  const float speckle =
      0.03F * scene_.noise().at(2.0F * place.x(), 2.0F * place.y(), 2.0F * std::max(width, depth));
  const float light = (0.30F + 0.55F * scene_.light().at(place.x(), place.y())) *
                      edge_shadow(edge.x(), 0.2F, 0.2F) * edge_shadow(edge.y(), 0.2F, 0.2F);
  float brightness = (0.80F + speckle) * light;
  brightness = mix(brightness, 1.25F, scene_.lamps().average(x, y));
  constexpr float kOffset = Scene::kTileOffsetM;
  const float bar = 0.58F * light;
  brightness = mix(brightness, bar, line_coverage(x, kOffset, kTile, 0.022F));
  return mix(brightness, bar, line_coverage(y, kOffset, kTile, 0.022F));
}

float PixelShader::solid(const View& view, const Ray& ray, const Nearest& hit) const {
  const SolidInView& seen = view.solids[static_cast<std::size_t>(hit.solid)];
  const Solid& solid = *seen.solid;
  const Ray own{seen.turned(ray.direction), seen.turned(ray.step_x), seen.turned(ray.step_y)};
  const float distance = hit.entry.distance;
  const Vector3f place = seen.eye_m + distance * own.direction;
  const int normal_axis = hit.entry.axis;
  const int axis = normal_axis == 0 ? 1 : 0, second = normal_axis == 2 ? 1 : 2;
  const float width = footprint(own, distance, axis, normal_axis);
  const float tall = footprint(own, distance, second, normal_axis);
  float shade = solid.shade;
  float facing = own.direction.z() < 0.0F ? 1.0F : 0.45F;  // from above or from below
  if (normal_axis < 2) {
    const Footprint u(place[axis] + 0.5F * solid.size_m[axis], width), v(place.z(), tall);
    shade = painted(shade, solid.faces[static_cast<std::size_t>(normal_axis)], u, v);
    facing = normal_axis == 0 ? 0.85F : 0.95F;
  }
  // Each box takes its grain from another part of the texture.
  const Vector2f from = solid.size_m.head<2>() * 7.0F;
  shade += 0.03F * scene_.noise().at(place[axis] + from.x(), place[second] + from.y(),
                                     std::max(width, tall));
  const Vector3f in_world = view.eye_m + distance * ray.direction;
  return shade * facing * scene_.light().at(in_world.x(), in_world.y());
}

}  // namespace vpdr::simulation
