#include "simulation/pixel_shader.hpp"

#include <cmath>

#include "simulation/building.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kTile = static_cast<float>(kTileM);
constexpr float kSmallestFootprintM = 2e-4F;

/// Darkening towards an edge where two surfaces meet.
float edge_shadow(float distance, float depth, float reach) {
  const float relative = distance / reach;
  return 1.0F - depth / (1.0F + relative * relative);
}

}  // namespace

PixelShader::PixelShader(const Scene& scene)
    : scene_(scene), height_(static_cast<float>(scene.plan().ceiling_m())) {}

float PixelShader::footprint(const Ray& ray, float distance, int axis, int normal_axis) {
  // A point on the plane moves with the ray and, along the ray, so that it stays on the plane.
  const float slope = ray.direction[axis] / ray.direction[normal_axis];
  const float by_x = ray.step_x[axis] - slope * ray.step_x[normal_axis];
  const float by_y = ray.step_y[axis] - slope * ray.step_y[normal_axis];
  return std::max(distance * (std::abs(by_x) + std::abs(by_y)), kSmallestFootprintM);
}

Shaded PixelShader::shade(const View& view, float x, float y) const {
  const Eigen::Matrix3f& r = view.world_from_camera;
  const Ray ray{r.col(0) * x + r.col(1) * y + r.col(2), r.col(0) * view.pixel_x,
                r.col(1) * view.pixel_y};
  const Vector3f& d = ray.direction;
  // Where floor or ceiling would end the ray.
  const float level = d.z() < 0.0F ? -view.eye_m.z() : height_ - view.eye_m.z();
  const float limit = std::abs(d.z()) > 1e-7F ? level / d.z() : 1e7F;
  const WallHit hit =
      scene_.plan().cast_from(view.cell, view.eye_m.head<2>().cast<double>(),
                              d.head<2>().cast<double>(), static_cast<double>(limit));
  if (hit.wall >= 0) {
    return {wall(view, ray, static_cast<float>(hit.distance), hit.wall), hit.wall + 2};
  }
  if (d.z() < 0.0F) return {floor(view, ray, limit, hit.cell), 0};
  return {ceiling(view, ray, limit, hit.cell), 1};
}

float PixelShader::wall(const View& view, const Ray& ray, float distance, int index) const {
  const Wall& geometry = scene_.plan().walls()[static_cast<std::size_t>(index)];
  const WallFace& face = scene_.faces()[static_cast<std::size_t>(index)];
  const int normal_axis = std::abs(geometry.normal.x()) > 0.5 ? 0 : 1;
  const int axis = 1 - normal_axis;
  const Vector3f place = view.eye_m + distance * ray.direction;
  const float from_start = place[axis] - static_cast<float>(geometry.start_m[axis]);
  const float along = std::abs(from_start);
  const float width = footprint(ray, distance, axis, normal_axis);
  const float tall = footprint(ray, distance, 2, normal_axis);
  const Footprint u(along, width), v(place.z(), tall);

  float shade = face.paint;
  for (const Patch& band : face.bands) shade = mix(shade, band.shade, coverage(v, band.up));
  const auto bucket = static_cast<std::size_t>(std::max(0.0F, u.low * 2.0F));
  const auto& first = face.first_object;
  for (auto i = static_cast<std::size_t>(first[std::min(bucket, first.size() - 1)]);
       i < face.objects.size() && face.objects[i].along.low < u.high; ++i) {
    for (const Patch& patch : face.objects[i].patches) {
      const float share = coverage(v, patch.up);
      if (share > 0.0F) shade = mix(shade, patch.shade, share * coverage(u, patch.along));
    }
  }
  shade += 0.022F * scene_.noise().at(along + face.texture_m, place.z(), std::max(width, tall));

  const auto length = static_cast<float>(geometry.length_m());
  float light = face.facing * edge_shadow(place.z(), 0.30F, 0.10F) *
                edge_shadow(height_ - place.z(), 0.22F, 0.20F);
  if (face.corner_left) light *= edge_shadow(along, 0.25F, 0.15F);
  if (face.corner_right) light *= edge_shadow(length - along, 0.25F, 0.15F);
  const Vector2f before = place.head<2>() + 0.15F * geometry.normal.cast<float>();
  return shade * light * scene_.light().at(before.x(), before.y());
}

float PixelShader::floor(const View& view, const Ray& ray, float distance, int cell) const {
  const Vector2f place = (view.eye_m + distance * ray.direction).head<2>();
  const float width = footprint(ray, distance, 0, 2), depth = footprint(ray, distance, 1, 2);
  const Footprint x(place.x(), width), y(place.y(), depth);
  const Eigen::Vector2f edge =
      scene_.plan().edge_distance_m(cell, place.cast<double>()).cast<float>();

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
         lamp_in_floor(view, ray, place, cell, x, y);
}

/// The lamps' image in the polished floor: their ray goes on upwards as if mirrored.
float PixelShader::lamp_in_floor(const View& view, const Ray& ray, const Vector2f& place, int cell,
                                 const Footprint& x, const Footprint& y) const {
  const Vector2f on = ray.direction.head<2>();
  const float rise = height_ / -ray.direction.z();
  const WallHit hit = scene_.plan().cast_from(cell, place.cast<double>(), on.cast<double>(),
                                              static_cast<double>(rise));
  if (hit.wall >= 0) return 0.0F;
  const Vector2f lamp = place + rise * on;
  const float spread = 1.0F + height_ / view.eye_m.z();
  constexpr float kBlurM = 0.25F;
  const float share = scene_.lamps().average(Footprint(lamp.x(), x.width() * spread + kBlurM),
                                             Footprint(lamp.y(), y.width() * spread + kBlurM));
  const float grazing = 1.0F + ray.direction.z() / ray.direction.norm();
  return (0.08F + 0.35F * grazing * grazing) * share;
}

float PixelShader::ceiling(const View& view, const Ray& ray, float distance, int cell) const {
  const Vector2f place = (view.eye_m + distance * ray.direction).head<2>();
  const float width = footprint(ray, distance, 0, 2), depth = footprint(ray, distance, 1, 2);
  const Footprint x(place.x(), width), y(place.y(), depth);
  const Eigen::Vector2f edge =
      scene_.plan().edge_distance_m(cell, place.cast<double>()).cast<float>();

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

}  // namespace vpdr::simulation
