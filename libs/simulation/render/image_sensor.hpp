#pragma once
// The camera's sensor: from light to grey levels, with the lens's loss of light in the corners,
// exposure, shot and read noise. Thread-safe once made.
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/camera.hpp"

namespace vpdr::simulation {

struct ImageSensorOptions {
  double read_noise = 1.4;   ///< in the dark, grey levels, standard deviation
  double shot_noise = 0.05;  ///< variance added by each grey level of light, grey levels squared
  double vignetting = 0.16;  ///< loss of light in the corners, relative

  /// A sensor without noise.
  static ImageSensorOptions quiet() {
    ImageSensorOptions options;
    options.read_noise = options.shot_noise = 0.0;
    return options;
  }
};

class ImageSensor {
 public:
  ImageSensor(const Camera& camera, std::uint64_t seed, const ImageSensorOptions& options);

  /// The picture, CV_8UC1, of light given as CV_32FC1, 0 black to 1 white, of the camera's size.
  /// `exposure` multiplies the light; `key` makes the noise of one picture differ from that of the
  /// next.
  [[nodiscard]] cv::Mat develop(const cv::Mat& light, double exposure, std::uint64_t key) const;

 private:
  ImageSensorOptions options_;
  std::uint64_t seed_;
  cv::Mat gain_;              ///< of the lens and of grey levels, of each pixel
  std::vector<float> noise_;  ///< normal numbers to draw from
};

}  // namespace vpdr::simulation
