#include "evaluation/report_scene.hpp"

#include <algorithm>
#include <limits>

#include "core/rotation.hpp"
#include "evaluation/interpolation.hpp"

namespace vpdr::evaluation {
namespace {

enum class Reference { kNone, kStart, kFit, kWaypoint };

Reference reference_of(const ReportScene& scene, const dataset::Recording* recording) {
  if (recording == nullptr) return Reference::kNone;
  if (scene.truth.size() >= 2) return recording->mag.empty() ? Reference::kFit : Reference::kStart;
  return scene.waypoints.empty() ? Reference::kNone : Reference::kWaypoint;
}

const char* sentence_of(Reference reference) {
  switch (reference) {
    case Reference::kNone:
      return "No position truth: the tracks are as estimated.";
    case Reference::kStart:
      return "The estimates are moved to the true start, and not rotated.";
    case Reference::kFit:
      return "The recording has no magnetometer, so yaw has no zero: the estimates are fitted to "
             "the truth in yaw and position.";
    case Reference::kWaypoint:
      return "The estimates are moved to the first waypoint at its time, and not rotated.";
  }
  return "";
}

YawAlignment alignment_of(const ReportScene& scene, const std::vector<StampedPose>& poses,
                          Reference reference) {
  YawAlignment alignment;
  if (reference == Reference::kNone || poses.empty()) return alignment;
  if (reference == Reference::kWaypoint) {
    const dataset::Waypoint& first = scene.waypoints.front();
    alignment.translation_m.head<2>() =
        first.position_m - position_at(poses, first.stamp_ns).head<2>();
    return alignment;
  }
  const std::vector<PositionPair> pairs = position_pairs(poses, scene.truth);
  if (pairs.empty()) return alignment;
  if (reference == Reference::kFit) return align_yaw(pairs);
  alignment.translation_m = pairs.front().truth_m - pairs.front().estimate_m;
  return alignment;
}

void measure(const ReportScene& scene, Track& track) {
  if (track.poses.empty()) return;
  const auto add = [&](TimestampNs stamp_ns, const Eigen::Vector2d& truth) {
    const Eigen::Vector2d place = position_at(track.poses, stamp_ns).head<2>();
    track.error_time_s.push_back(scene.seconds(stamp_ns));
    track.error_m.push_back((place - truth).norm());
  };
  if (scene.truth.size() >= 2) {
    for (const PositionPair& pair : position_pairs(track.poses, scene.truth)) {
      add(pair.stamp_ns, pair.truth_m.head<2>());
    }
    return;
  }
  for (const dataset::Waypoint& waypoint : scene.waypoints) {
    add(waypoint.stamp_ns, waypoint.position_m);
  }
}

Track aligned_track(const ReportScene& scene, const std::vector<StampedPose>& poses,
                    Reference reference) {
  const YawAlignment alignment = alignment_of(scene, poses, reference);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(alignment.yaw_rad, Eigen::Vector3d::UnitZ()));
  Track track;
  track.yaw_shift_rad = alignment.yaw_rad;
  track.poses.reserve(poses.size());
  for (const StampedPose& pose : poses) {
    track.poses.push_back(
        {pose.stamp_ns, alignment.apply(pose.position_m), turn * pose.world_from_body});
  }
  measure(scene, track);
  return track;
}

void collect_truth(const dataset::Recording& recording, ReportScene& scene) {
  const Eigen::Quaterniond sensor_from_body(recording.about.mount.transpose());
  for (dataset::TruthPose pose : recording.truth.poses) {
    if (pose.has_position()) scene.truth.push_back(pose);
    if (!pose.has_attitude()) continue;
    pose.world_from_sensor = pose.world_from_sensor * sensor_from_body;
    scene.truth_attitude.push_back(pose);
  }
  scene.waypoints = recording.truth.waypoints;
}

template <class Row>
void include_times(const std::vector<Row>& rows, TimestampNs& first, TimestampNs& last) {
  if (rows.empty()) return;
  first = std::min(first, rows.front().stamp_ns);
  last = std::max(last, rows.back().stamp_ns);
}

void set_times(ReportScene& scene) {
  TimestampNs first = std::numeric_limits<TimestampNs>::max();
  TimestampNs last = std::numeric_limits<TimestampNs>::min();
  include_times(scene.run.fused, first, last);
  include_times(scene.run.pdr, first, last);
  include_times(scene.run.attitude, first, last);
  include_times(scene.run.vision_heading, first, last);
  if (first > last) return;
  scene.start_ns = first;
  scene.end_s = std::max(to_seconds(last - first), 1e-3);
}

}  // namespace

ReportScene make_scene(const RunDirectory& run, const dataset::Recording* recording) {
  ReportScene scene{run, recording, 0, 1.0, {}, {}, run.covariance, {}, {}, {}, {}};
  set_times(scene);
  if (recording != nullptr) collect_truth(*recording, scene);
  const Reference reference = reference_of(scene, recording);
  scene.alignment = sentence_of(reference);
  scene.fused = aligned_track(scene, run.fused, reference);
  scene.pdr = aligned_track(scene, run.pdr, reference);
  const Eigen::Rotation2Dd turn(scene.fused.yaw_shift_rad);
  for (StampedCovariance& row : scene.covariance) {
    row.position_m2 =
        turn.toRotationMatrix() * row.position_m2 * turn.toRotationMatrix().transpose();
  }
  return scene;
}

}  // namespace vpdr::evaluation
