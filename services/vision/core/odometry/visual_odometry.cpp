#include "vision/core/odometry/visual_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kUpSigmaRad = 0.02;  // of a vertical that comes from the image
constexpr std::size_t kStillPoints = 15;

/// The camera's own height where the settings name none.
MetricScaleConfig with_height(MetricScaleConfig config, const CameraParameters& camera) {
  if (config.camera_height_m == 0.0) config.camera_height_m = camera.height_m;
  return config;
}

}  // namespace

const char* name_of(MotionOutcome outcome) {
  static constexpr const char* kNames[kMotionOutcomeCount] = {
      "moved",     "still",     "starting", "bridged", "few_points",
      "after_gap", "not_later", "repeated", "unfit",   "library_fault"};
  return kNames[static_cast<std::size_t>(outcome)];
}

VisualOdometry::VisualOdometry(const OdometryConfig& config, const FrameCheckConfig& check,
                               const CameraModel& camera)
    : config_(config),
      check_(check),
      camera_(camera),
      tracker_(config.tracker, camera),
      map_(config.map),
      gyro_(config.gyro),
      scale_(with_height(config.scale, camera.parameters())),
      chain_(config.chain),
      stillness_(config.stillness, config.gyro.bias_sigma_radps) {}

OdometryOutput VisualOdometry::process(const OdometryInput& input) {
  OdometryOutput out;
  try {
    out.outcome = judge(input, out);
  } catch (const cv::Exception&) {
    out.outcome = MotionOutcome::kLibraryFault;
  }
  ++counts_[static_cast<std::size_t>(out.outcome)];
  return out;
}

MotionOutcome VisualOdometry::judge(const OdometryInput& input, OdometryOutput& out) {
  if (last_stamp_ns_ && input.stamp_ns <= *last_stamp_ns_) return MotionOutcome::kNotLater;
  last_stamp_ns_ = input.stamp_ns;
  const CameraParameters& p = camera_.parameters();
  out.frame = check_frame(input.grey, p.width_px, p.height_px, check_);
  if (out.frame != FrameOutcome::kFound) return MotionOutcome::kUnfit;
  if (is_repeated(input.grey)) return MotionOutcome::kRepeated;
  if (last_fit_ns_ && to_seconds(input.stamp_ns - *last_fit_ns_) > config_.max_gap_s) {
    begin_anew(input);
    return MotionOutcome::kAfterGap;
  }
  return follow(input, out);
}

// A stuck camera or decoder gives the very same pixels, which no sensor does.
bool VisualOdometry::is_repeated(const cv::Mat& image) {
  const std::uint64_t fingerprint = fingerprint_of(image);
  return std::exchange(last_fingerprint_, fingerprint) == fingerprint;
}

void VisualOdometry::begin_anew(const OdometryInput& input) {
  tracker_.reset();
  map_.restart();
  scale_.restart();
  stillness_.restart();
  if (chain_.started()) coast(input.stamp_ns, input.attitude);
  tracker_.track(input.grey, input.stamp_ns, {});
  map_.process(tracker_.tracks(), std::nullopt, config_.pixel_sigma_px / camera_.focal_px(), {});
  last_fit_ns_ = input.stamp_ns;
  last_attitude_ = input.attitude;
}

std::optional<GyroAid::Turn> VisualOdometry::turn_since_last(const OdometryInput& input) const {
  const auto measured = turn_between(last_attitude_, input.attitude);
  if (!measured || !last_fit_ns_) return std::nullopt;
  return gyro_.corrected(*measured, to_seconds(input.stamp_ns - *last_fit_ns_));
}

std::optional<RotationPrior> VisualOdometry::camera_turn(
    const std::optional<GyroAid::Turn>& turn) const {
  if (!turn) return std::nullopt;
  const Matrix3d& mount = camera_.parameters().body_from_camera;
  return RotationPrior{mount.transpose() * turn->rotation.toRotationMatrix() * mount,
                       turn->sigma_rad};
}

MotionOutcome VisualOdometry::follow(const OdometryInput& input, OdometryOutput& out) {
  const auto turn = turn_since_last(input);
  const auto camera_turned = camera_turn(turn);
  map_.expect(tracker_.tracks(), input.stamp_ns, camera_turned, expected_);
  const FeatureTracks& frame = tracker_.track(input.grey, input.stamp_ns, expected_);
  if (!chain_.started()) {
    const auto up = up_camera(input);
    chain_.start(input.stamp_ns,
                 input.attitude ? input.attitude->world_from_body : Quaterniond::Identity(),
                 up ? up->second : 0.3);
    chain_attitude_ = input.attitude;
  }
  const bool still = stillness_.stands_still(frame, input.attitude);
  const double dt = last_fit_ns_ ? to_seconds(input.stamp_ns - *last_fit_ns_) : 0.0;
  const bool few = frame.features.size() < config_.least_features;
  const MapStep step =
      still ? map_.hold(frame)
            : map_.process(frame, camera_turned, config_.pixel_sigma_px / camera_.focal_px(),
                           scale_.metres());
  if (step.new_map) scale_.restart();
  if (!still) learn_bias(turn, step, dt);
  see_scale(input, step);
  if (last_fit_ns_) out.motion = describe(input, step);
  if (still && out.motion) out.motion->metric = true;
  out.key_frame = step.key_frame;
  chain_up(input, step, out);
  last_fit_ns_ = input.stamp_ns;
  last_attitude_ = input.attitude;
  if (still) return MotionOutcome::kStill;
  if (few) return MotionOutcome::kFewPoints;
  switch (step.state) {
    case MapState::kTracking:
      return MotionOutcome::kMoved;
    case MapState::kBridging:
      return MotionOutcome::kBridged;
    case MapState::kStarting:
      break;
  }
  return MotionOutcome::kStarting;
}

void VisualOdometry::learn_bias(const std::optional<GyroAid::Turn>& turn, const MapStep& step,
                                double dt_s) {
  if (!turn || step.state != MapState::kTracking || step.new_map) return;
  const Matrix3d& mount = camera_.parameters().body_from_camera;
  const Matrix3d seen =
      mount *
      (step.previous.map_from_camera.conjugate() * step.pose.map_from_camera).toRotationMatrix() *
      mount.transpose();
  const Vector3d correction =
      log_rotation((turn->rotation.conjugate() * Quaterniond(seen)).normalized());
  gyro_.learn(*turn, dt_s, correction,
              mount * step.covariance.bottomRightCorner<3, 3>() * mount.transpose());
}

std::optional<std::pair<Vector3d, double>> VisualOdometry::up_camera(
    const OdometryInput& input) const {
  if (input.attitude) {
    const Vector3d up_body = input.attitude->world_from_body.conjugate() * Vector3d::UnitZ();
    return std::pair{(camera_.parameters().body_from_camera.transpose() * up_body).eval(),
                     input.attitude->inclination_sigma_rad};
  }
  if (input.up_camera) return std::pair{*input.up_camera, kUpSigmaRad};
  return std::nullopt;
}

void VisualOdometry::see_scale(const OdometryInput& input, const MapStep& step) {
  if (step.state == MapState::kStarting) return;
  if (!step.new_map) scale_.wander((step.pose.position - step.previous.position).norm());
  scale_.follow(input.stamp_ns, step.pose.position);
  const auto up = up_camera(input);
  if (!step.key_frame || !up) return;
  scale_.look(map_.landmarks(), tracker_.tracks(), step.pose, step.pose.map_from_camera * up->first,
              up->second);
}

// ------------------------------------------------------------------------------- what comes out

MotionEstimate VisualOdometry::motion_of(const CameraPose& earlier, const CameraPose& later,
                                         const Matrix6d& covariance, double metres) const {
  const CameraParameters& p = camera_.parameters();
  const Matrix3d& mount = p.body_from_camera;
  const Matrix3d earlier_from_map = earlier.map_from_camera.conjugate().toRotationMatrix();
  const Matrix3d turned = earlier_from_map * later.map_from_camera.toRotationMatrix();
  const Vector3d moved = earlier_from_map * (later.position - earlier.position) * metres;
  MotionEstimate motion;
  const Matrix3d rotation = mount * turned * mount.transpose();
  motion.rotation = Quaterniond(rotation).normalized();
  motion.translation_m = mount * moved + p.position_m - rotation * p.position_m;
  const double factor = config_.covariance_factor * config_.covariance_factor;
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = metres * mount * earlier_from_map;
  turn.bottomRightCorner<3, 3>() = mount * turned;
  motion.covariance = factor * turn * covariance * turn.transpose();
  return motion;
}

std::optional<MotionEstimate> VisualOdometry::describe(const OdometryInput& input,
                                                       const MapStep& step) const {
  if (step.state == MapState::kStarting || step.new_map) return describe_start(input, step);
  const auto metres = scale_.metres();
  MotionEstimate motion =
      motion_of(step.previous, step.pose, step.covariance, metres.value_or(1.0));
  motion.stamp_ns = input.stamp_ns;
  motion.interval_start_ns = *last_fit_ns_;
  motion.metric = metres.has_value();
  motion.inliers = static_cast<std::uint32_t>(step.inliers);
  const double share = scale_.sigma_share();
  motion.covariance.topLeftCorner<3, 3>() +=
      share * share * motion.translation_m * motion.translation_m.transpose();
  return motion;
}

// Before there is a map: rotation and direction from the frame before; the length is arbitrary.
std::optional<MotionEstimate> VisualOdometry::describe_start(const OdometryInput& input,
                                                             const MapStep& step) const {
  if (!step.two_frames || step.two_frames->model == MotionModel::kNone) {
    if (step.state != MapState::kStarting || step.inliers < kStillPoints) return std::nullopt;
  }
  MotionEstimate motion;
  if (step.two_frames) {
    const RelativeMotion& seen = *step.two_frames;
    CameraPose later{seen.direction, Quaterniond(seen.earlier_from_later).normalized()};
    Matrix6d covariance;
    covariance.topLeftCorner<3, 3>() = seen.covariance.bottomRightCorner<3, 3>();
    covariance.bottomRightCorner<3, 3>() = seen.covariance.topLeftCorner<3, 3>();
    covariance.topRightCorner<3, 3>() = seen.covariance.bottomLeftCorner<3, 3>();
    covariance.bottomLeftCorner<3, 3>() = seen.covariance.topRightCorner<3, 3>();
    motion = motion_of({}, later, covariance, 1.0);
    motion.translation_m = camera_.parameters().body_from_camera * seen.direction;
  } else {
    motion.covariance = step.covariance;
  }
  motion.stamp_ns = input.stamp_ns;
  motion.interval_start_ns = *last_fit_ns_;
  motion.inliers = static_cast<std::uint32_t>(step.inliers);
  return motion;
}

// The chain stands where the last metric motion ended; while the scale is unknown it waits there.
void VisualOdometry::chain_up(const OdometryInput& input, const MapStep& step,
                              OdometryOutput& out) {
  const TimestampNs behind = chain_.pose().stamp_ns;
  if (step.new_map) {
    chain_pose_ = step.start;
    if (step.start_ns > behind) coast(step.start_ns, std::nullopt);
  }
  if (step.state == MapState::kStarting) {
    chain_pose_.reset();
    if (step.held) {
      MotionEstimate none;
      none.stamp_ns = input.stamp_ns;
      none.covariance = step.covariance;
      chain_.advance(none, 0.0);
      chain_attitude_ = input.attitude;
      if (scale_known_once_) out.odometry = chain_.pose();
    } else if (step.new_reference && input.stamp_ns > behind) {
      coast(input.stamp_ns, input.attitude);
    }
    return;
  }
  if (!chain_pose_) chain_pose_ = step.previous;
  const auto metres = scale_.metres();
  if (!metres) return;
  MotionEstimate motion = motion_of(*chain_pose_, step.pose, step.covariance, *metres);
  motion.stamp_ns = input.stamp_ns;
  chain_.advance(motion, scale_.sigma_share());
  chain_pose_ = step.pose;
  chain_attitude_ = input.attitude;
  if (const auto up = up_camera(input)) {
    chain_.level(camera_.parameters().body_from_camera * up->first, up->second,
                 std::max(1e-3, to_seconds(input.stamp_ns - behind)));
  }
  scale_known_once_ = true;
  out.odometry = chain_.pose();
}

// Nothing was seen: the gyroscope knows the turn, the place is anybody's guess.
void VisualOdometry::coast(TimestampNs until_ns, const std::optional<AttitudePrior>& attitude) {
  const double dt = to_seconds(until_ns - chain_.pose().stamp_ns);
  MotionEstimate motion;
  motion.stamp_ns = until_ns;
  const auto turned = turn_between(chain_attitude_, attitude);
  if (turned) motion.rotation = *turned;
  const double turn_sigma = turned ? config_.gyro.bias_sigma_radps * dt : 0.5;
  const double way_sigma = config_.coast_sigma_mps * dt;
  motion.covariance.diagonal() << Vector3d::Constant(way_sigma * way_sigma),
      Vector3d::Constant(turn_sigma * turn_sigma);
  chain_.advance(motion, 0.0);
  chain_attitude_ = attitude;
}

}  // namespace vpdr::vision
