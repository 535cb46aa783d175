#include "simulation/corridor_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "simulation/pixel_shader.hpp"
#include "simulation/scene.hpp"

namespace vpdr::simulation {
namespace {

constexpr std::size_t kNoiseNumbers = 1U << 16;
constexpr float kExposure = 290.0F;
constexpr float kShotNoise = 0.012F;  // noise added for each grey level of light

/// Places of the four samples within a pixel whose neighbour shows another surface.
constexpr float kSubPixels[4][2] = {
    {-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}};

}  // namespace

CorridorRenderer::~CorridorRenderer() = default;

CorridorRenderer::CorridorRenderer(const FloorPlan& plan, const Camera& camera, std::uint64_t seed,
                                   const RenderOptions& options)
    : camera_(camera),
      options_(options),
      seed_(seed),
      scene_(std::make_unique<Scene>(plan, seed)),
      shader_(std::make_unique<PixelShader>(*scene_)) {
  const double corner = std::hypot(0.5 * camera.width, 0.5 * camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      rays_.push_back(camera.normalised({column, row}).cast<float>());
      const double radius = std::hypot(column - 0.5 * camera.width, row - 0.5 * camera.height);
      const double share = radius / corner;
      gain_.push_back(static_cast<float>(1.0 - options.vignetting * share * share));
    }
  }
  Random random(seed, "pixel noise");
  for (std::size_t i = 0; i < kNoiseNumbers; ++i) {
    noise_.push_back(static_cast<float>(random.normal()));
  }
}

cv::Mat CorridorRenderer::render(const Eigen::Isometry3d& world_from_camera,
                                 std::uint64_t noise_key) const {
  const Eigen::Vector3d eye = world_from_camera.translation();
  View view;
  view.cell = scene_->plan().cell_at(eye.head<2>());
  if (view.cell < 0 || !(eye.z() > 0.0 && eye.z() < scene_->plan().ceiling_m())) {
    throw std::domain_error("render: the camera is not in a corridor");
  }
  view.eye_m = eye.cast<float>();
  view.world_from_camera = world_from_camera.linear().cast<float>();
  view.pixel_x = static_cast<float>(1.0 / camera_.fx);
  view.pixel_y = static_cast<float>(1.0 / camera_.fy);

  cv::Mat image(camera_.height, camera_.width, CV_8UC1);
  const int bands = std::clamp(options_.threads, 1, camera_.height);
  std::vector<std::thread> others;
  const auto first_row = [&](int band) { return band * camera_.height / bands; };
  for (int band = 1; band < bands; ++band) {
    others.emplace_back(
        [&, band] { render_rows(view, noise_key, first_row(band), first_row(band + 1), image); });
  }
  render_rows(view, noise_key, 0, first_row(1), image);
  for (std::thread& other : others) other.join();
  return image;
}

void CorridorRenderer::render_rows(const View& view, std::uint64_t noise_key, int first, int last,
                                   cv::Mat& image) const {
  const auto width = static_cast<std::size_t>(camera_.width);
  // Three rows at a time: a pixel is on an edge if a neighbour shows another surface.
  std::vector<float> above(width), here(width), below(width), smooth(width);
  std::vector<int> surface_above(width), surface(width), surface_below(width);
  shade_row(view, std::max(0, first - 1), above, surface_above);
  shade_row(view, first, here, surface);
  for (int row = first; row < last; ++row) {
    shade_row(view, std::min(row + 1, camera_.height - 1), below, surface_below);
    for (std::size_t i = 0; i < width; ++i) {
      const std::size_t left = i > 0 ? i - 1 : i, right = std::min(i + 1, width - 1);
      const int s = surface[i];
      const bool edge = s != surface[left] || s != surface[right] || s != surface_above[i] ||
                        s != surface_below[i];
      smooth[i] = edge ? smooth_edge(view, row, static_cast<int>(i)) : here[i];
    }
    develop(row, noise_key, smooth, image.ptr<std::uint8_t>(row));
    std::swap(above, here);
    std::swap(here, below);
    std::swap(surface_above, surface);
    std::swap(surface, surface_below);
  }
}

void CorridorRenderer::shade_row(const View& view, int row, std::vector<float>& brightness,
                                 std::vector<int>& surface) const {
  const auto width = static_cast<std::size_t>(camera_.width);
  const Eigen::Vector2f* ray = &rays_[static_cast<std::size_t>(row) * width];
  for (std::size_t i = 0; i < width; ++i) {
    const Shaded shaded = shader_->shade(view, ray[i].x(), ray[i].y());
    brightness[i] = shaded.brightness;
    surface[i] = shaded.surface;
  }
}

float CorridorRenderer::smooth_edge(const View& view, int row, int column) const {
  const Eigen::Vector2f& ray =
      rays_[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width) +
            static_cast<std::size_t>(column)];
  View fine = view;
  fine.pixel_x *= 0.5F;
  fine.pixel_y *= 0.5F;
  float sum = 0.0F;
  for (const auto& [dx, dy] : kSubPixels) {
    const Shaded shaded =
        shader_->shade(fine, ray.x() + dx * view.pixel_x, ray.y() + dy * view.pixel_y);
    sum += std::min(shaded.brightness, 1.1F);
  }
  return 0.25F * sum;
}

void CorridorRenderer::develop(int row, std::uint64_t noise_key,
                               const std::vector<float>& brightness, std::uint8_t* pixels) const {
  const std::uint64_t key =
      mix_bits(mix_bits(seed_ ^ mix_bits(noise_key)) + static_cast<std::uint64_t>(row));
  std::size_t draw = key % kNoiseNumbers;
  const float* gain = &gain_[static_cast<std::size_t>(row) * brightness.size()];
  const auto dark = static_cast<float>(options_.noise);
  const float per_level = options_.noise > 0.0 ? kShotNoise : 0.0F;
  for (std::size_t i = 0; i < brightness.size(); ++i) {
    const float light = kExposure * gain[i] * brightness[i];
    const float grey = light + (dark + per_level * light) * noise_[draw];
    draw = (draw + 1) % kNoiseNumbers;
    pixels[i] = static_cast<std::uint8_t>(std::clamp(grey + 0.5F, 0.0F, 255.0F));
  }
}

}  // namespace vpdr::simulation
