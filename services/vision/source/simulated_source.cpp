#include "vision/source/simulated_source.hpp"

#include <algorithm>
#include <exception>

#include "simulation/walk_camera.hpp"

namespace vpdr::vision {
namespace {

class SimulatedSource : public FrameSource {
 public:
  explicit SimulatedSource(const simulation::WalkOptions& options)
      : camera_(simulation::simulate_walk(options)) {}

  [[nodiscard]] std::optional<TimestampNs> next_stamp() const override {
    if (next_ == camera_.count()) return std::nullopt;
    return camera_.stamp(next_);
  }

  Frame load() override {
    Frame frame{camera_.stamp(next_), {}, {}};
    try {
      frame.image = camera_.image(next_);
    } catch (const std::exception& error) {
      frame.problem = "simulated frame " + std::to_string(next_) + ": " + error.what() +
                      "; report the seed of this walk";
    }
    ++next_;
    return frame;
  }

 private:
  simulation::WalkCamera camera_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> make_simulated_source(const simulation::WalkOptions& options) {
  return std::make_unique<SimulatedSource>(options);
}

CameraModel make_camera(const simulation::Camera& camera) {
  CameraParameters p;
  p.width_px = camera.width;
  p.height_px = camera.height;
  p.fx_px = camera.fx;
  p.fy_px = camera.fy;
  p.cx_px = camera.cx;
  p.cy_px = camera.cy;
  p.distortion = camera.lens == simulation::Lens::kEquidistant ? Distortion::kEquidistant
                                                               : Distortion::kRadialTangential;
  std::copy(camera.distortion.begin(), camera.distortion.end(), p.coefficients.begin());
  p.body_from_camera = camera.body_from_camera.linear();
  p.position_m = camera.body_from_camera.translation();
  return CameraModel(p);
}

}  // namespace vpdr::vision
