#include "simulation/render/image_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/random.hpp"

namespace vpdr::simulation {
namespace {

constexpr std::size_t kNoiseNumbers = 1U << 16;
constexpr double kGreyOfWhite = 290.0;

}  // namespace

ImageSensor::ImageSensor(const Camera& camera, std::uint64_t seed,
                         const ImageSensorOptions& options)
    : options_(options), seed_(seed), gain_(camera.height, camera.width, CV_32FC1) {
  const double corner = std::hypot(0.5 * camera.width, 0.5 * camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const double share =
          std::hypot(column - 0.5 * camera.width, row - 0.5 * camera.height) / corner;
      gain_.at<float>(row, column) =
          static_cast<float>(kGreyOfWhite * (1.0 - options.vignetting * share * share));
    }
  }
  Random random(seed, "pixel noise");
  for (std::size_t i = 0; i < kNoiseNumbers; ++i) {
    noise_.push_back(static_cast<float>(random.normal()));
  }
}

cv::Mat ImageSensor::develop(const cv::Mat& light, double exposure, std::uint64_t key) const {
  cv::Mat image(light.size(), CV_8UC1);
  const auto times = static_cast<float>(exposure);
  const auto dark = static_cast<float>(options_.read_noise * options_.read_noise);
  const auto per_level = static_cast<float>(options_.shot_noise);
  for (int row = 0; row < light.rows; ++row) {
    const std::uint64_t of_row =
        mix_bits(mix_bits(seed_ ^ mix_bits(key)) + static_cast<std::uint64_t>(row));
    std::size_t draw = of_row % kNoiseNumbers;
    const auto* in = light.ptr<float>(row);
    const auto* gain = gain_.ptr<float>(row);
    auto* out = image.ptr<std::uint8_t>(row);
    for (int i = 0; i < light.cols; ++i) {
      const float level = times * gain[i] * in[i];
      const float grey = level + std::sqrt(dark + per_level * level) * noise_[draw];
      draw = (draw + 1) % kNoiseNumbers;
      out[i] = static_cast<std::uint8_t>(std::clamp(grey + 0.5F, 0.0F, 255.0F));
    }
  }
  return image;
}

}  // namespace vpdr::simulation
