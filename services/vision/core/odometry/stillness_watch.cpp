#include "vision/core/odometry/stillness_watch.hpp"

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

constexpr std::size_t kLeastPoints = 15;
constexpr double kMost = 3.0;  // times still_px: nine in ten points stay within

}  // namespace

bool StillnessWatch::stands_still(const FeatureTracks& frame,
                                  const std::optional<AttitudePrior>& attitude) {
  const double age = to_seconds(frame.stamp_ns - reference_.stamp_ns);
  const Displacement moved = displacement_between(reference_, frame, values_);
  const auto turned = turn_between(reference_attitude_, attitude);
  const bool contradicted = turned && log_rotation(*turned).norm() >
                                          config_.still_turn_rad + age * gyro_bias_sigma_radps_;
  const bool stayed = moved.matches >= kLeastPoints && moved.median_px < config_.still_px &&
                      moved.most_px < kMost * config_.still_px && !contradicted;
  if (!stayed || 2 * moved.matches < frame.features.size()) {
    reference_ = frame;
    reference_attitude_ = attitude;
  }
  return stayed && age >= config_.still_s;
}

}  // namespace vpdr::vision
