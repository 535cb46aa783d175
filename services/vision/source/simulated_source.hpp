#pragma once
// The pictures of a simulated walk, rendered when they are asked for.
#include <memory>

#include "simulation/walk.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/source/frame_source.hpp"

namespace vpdr::vision {

/// Frames of the walk that these options give. Throws ConfigurationFault where they give none.
std::unique_ptr<FrameSource> make_simulated_source(const simulation::WalkOptions& options);

/// The simulated walker's camera.
CameraModel make_camera(const simulation::Camera& camera);

}  // namespace vpdr::vision
