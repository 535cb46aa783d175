#include "simulation/render/scene_renderer.hpp"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "simulation/render/pixel_shader.hpp"
#include "simulation/render/ray_table.hpp"
#include "simulation/render/scene.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3f;

/// Places of the four samples within a pixel whose neighbour shows another surface.
constexpr float kSubPixels[4][2] = {
    {-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}};
constexpr float kBrightest = 1.1F;  // of one such sample: a lamp does not outshine its edge

}  // namespace

/// What all pixels of one picture share.
struct SceneRenderer::Frame {
  View view;
  Eigen::Matrix3f world_from_camera;
  std::vector<std::uint16_t> candidates;  ///< solids of all tiles, tile by tile
  std::vector<std::uint32_t> first;       ///< of each tile in it, and its end

  [[nodiscard]] Candidates of_tile(int tile) const {
    const auto t = static_cast<std::size_t>(tile);
    return {candidates.data() + first[t], candidates.data() + first[t + 1]};
  }
};

/// One row of pixels at work.
struct SceneRenderer::Row {
  explicit Row(std::size_t width)
      : rays(width + 1), steps_down(width), light(width), surface(width) {}
  std::vector<Vector3f> rays;        ///< in the world
  std::vector<Vector3f> steps_down;  ///< to the ray one pixel below
  std::vector<float> light;
  std::vector<int> surface;

  [[nodiscard]] Ray ray(std::size_t column) const {
    return {rays[column], rays[column + 1] - rays[column], steps_down[column]};
  }
};

SceneRenderer::~SceneRenderer() = default;

SceneRenderer::SceneRenderer(const FloorPlan& plan, const Camera& camera, std::uint64_t seed,
                             const RenderOptions& options, std::vector<Solid> furniture)
    : camera_(camera),
      threads_(std::clamp(options.threads, 1, camera.height)),
      sensor_(camera, seed, options.sensor),
      scene_(std::make_unique<Scene>(plan, seed, std::move(furniture))),
      shader_(std::make_unique<PixelShader>(*scene_)),
      rays_(std::make_unique<RayTable>(camera)) {}

SceneRenderer::Frame SceneRenderer::frame_of(const Eigen::Isometry3d& world_from_camera,
                                             const std::vector<Solid>& others) const {
  Frame frame;
  const Eigen::Vector3d eye = world_from_camera.translation();
  frame.view.eye_m = eye.cast<float>();
  frame.view.cell = scene_->plan().cell_at(eye.head<2>());
  if (frame.view.cell >= 0) {
    const Cell& cell = scene_->plan().cell(frame.view.cell);
    if (!(eye.z() > cell.floor_m && eye.z() < cell.ceiling_m)) frame.view.cell = -1;
  }
  if (frame.view.cell < 0) throw std::domain_error("render: the camera is not in free space");
  frame.world_from_camera = world_from_camera.linear().cast<float>();
  std::vector<const Solid*> solids;
  for (const Solid& solid : scene_->furniture()) solids.push_back(&solid);
  for (const Solid& solid : others) solids.push_back(&solid);
  find_candidates(world_from_camera, solids, frame);
  return frame;
}

void SceneRenderer::find_candidates(const Eigen::Isometry3d& world_from_camera,
                                    const std::vector<const Solid*>& solids, Frame& frame) const {
  const Eigen::Isometry3f camera_from_world = world_from_camera.inverse().cast<float>();
  std::vector<Ball> balls;
  for (const Solid* solid : solids) {
    frame.view.solids.emplace_back(*solid, frame.view.eye_m);
    Ball ball = ball_around(*solid);
    ball.middle_m = camera_from_world * ball.middle_m;
    balls.push_back(ball);
  }
  frame.first.reserve(static_cast<std::size_t>(rays_->tiles()) + 1);
  for (int tile = 0; tile < rays_->tiles(); ++tile) {
    frame.first.push_back(static_cast<std::uint32_t>(frame.candidates.size()));
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (rays_->may_see(tile, balls[i])) {
        frame.candidates.push_back(static_cast<std::uint16_t>(i));
      }
    }
  }
  frame.first.push_back(static_cast<std::uint32_t>(frame.candidates.size()));
}

template <class Work>
void SceneRenderer::in_bands(const Work& work) const {
  std::vector<std::thread> others;
  const auto first_row = [&](int band) { return band * camera_.height / threads_; };
  for (int band = 1; band < threads_; ++band) {
    others.emplace_back([&, band] { work(first_row(band), first_row(band + 1)); });
  }
  work(0, first_row(1));
  for (std::thread& other : others) other.join();
}

cv::Mat SceneRenderer::render(const Eigen::Isometry3d& world_from_camera,
                              std::uint64_t noise_key) const {
  return sensor_.develop(light(world_from_camera), 1.0, noise_key);
}

cv::Mat SceneRenderer::light(const Eigen::Isometry3d& world_from_camera,
                             const std::vector<Solid>& others) const {
  const Frame frame = frame_of(world_from_camera, others);
  cv::Mat light(camera_.height, camera_.width, CV_32FC1);
  in_bands([&](int first, int last) { light_rows(frame, first, last, light); });
  return light;
}

cv::Mat SceneRenderer::ranges(const Eigen::Isometry3d& world_from_camera,
                              const std::vector<Solid>& others) const {
  const Frame frame = frame_of(world_from_camera, others);
  cv::Mat ranges(camera_.height, camera_.width, CV_32FC1);
  in_bands([&](int first, int last) {
    for (int row = first; row < last; ++row) {
      const int tile_row = row / RayTable::kTile * rays_->tile_columns();
      for (int column = 0; column < camera_.width; ++column) {
        ranges.at<float>(row, column) =
            shader_->distance(frame.view, frame.world_from_camera * rays_->row(row)[column],
                              frame.of_tile(tile_row + column / RayTable::kTile));
      }
    }
  });
  return ranges;
}

void SceneRenderer::light_rows(const Frame& frame, int first, int last, cv::Mat& light) const {
  const auto width = static_cast<std::size_t>(camera_.width);
  // Three rows at a time: a pixel is on an edge if a neighbour shows another surface.
  Row above(width), here(width), below(width);
  shade_row(frame, std::max(0, first - 1), above);
  shade_row(frame, first, here);
  for (int row = first; row < last; ++row) {
    shade_row(frame, std::min(row + 1, camera_.height - 1), below);
    auto* out = light.ptr<float>(row);
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t left = i > 0 ? i - 1 : i, right = std::min(i + 1, width - 1);
      const int s = here.surface[i];
      const bool edge = s != here.surface[left] || s != here.surface[right] ||
                        s != above.surface[i] || s != below.surface[i];
      out[i] = edge ? smooth_edge(frame, here, row, i) : here.light[i];
    }
    std::swap(above, here);
    std::swap(here, below);
  }
}

void SceneRenderer::shade_row(const Frame& frame, int row, Row& out) const {
  const Vector3f *own = rays_->row(row), *under = rays_->row(row + 1);
  const auto width = static_cast<std::size_t>(camera_.width);
  const Eigen::Matrix3f& r = frame.world_from_camera;
  for (std::size_t i = 0; i <= width; ++i) out.rays[i].noalias() = r * own[i];
  for (std::size_t i = 0; i < width; ++i) out.steps_down[i].noalias() = r * (under[i] - own[i]);
  const int tile_row = row / RayTable::kTile * rays_->tile_columns();
  for (std::size_t i = 0; i < width; ++i) {
    const Shaded shaded = shader_->shade(
        frame.view, out.ray(i), frame.of_tile(tile_row + static_cast<int>(i) / RayTable::kTile));
    out.light[i] = shaded.brightness;
    out.surface[i] = shaded.surface;
  }
}

float SceneRenderer::smooth_edge(const Frame& frame, const Row& row, int number,
                                 std::size_t column) const {
  const Ray ray = row.ray(column);
  const Candidates candidates = frame.of_tile(number / RayTable::kTile * rays_->tile_columns() +
                                              static_cast<int>(column) / RayTable::kTile);
  Ray fine{ray.direction, 0.5F * ray.step_x, 0.5F * ray.step_y};
  float sum = 0.0F;
  for (const auto& [dx, dy] : kSubPixels) {
    fine.direction = ray.direction + dx * ray.step_x + dy * ray.step_y;
    sum += std::min(shader_->shade(frame.view, fine, candidates).brightness, kBrightest);
  }
  return 0.25F * sum;
}

std::array<Eigen::Vector3d, 3> building_directions(const Eigen::Isometry3d& world_from_camera) {
  const Eigen::Matrix3d camera_from_world = world_from_camera.linear().transpose();
  return {camera_from_world.col(0), camera_from_world.col(1), camera_from_world.col(2)};
}

}  // namespace vpdr::simulation
