#include "bench/true_motion.hpp"

#include <algorithm>
#include <iterator>

#include "dataset/truth_tables.hpp"

namespace vpdr::bench {

namespace fs = std::filesystem;

std::vector<dataset::TruthPose> read_tum(const fs::path& file) {
  dataset::ReadReport report;
  return dataset::read_tum(file, report);
}

std::optional<Eigen::Isometry3d> pose_at(const std::vector<dataset::TruthPose>& poses,
                                         TimestampNs stamp_ns) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp_ns,
                       [](const dataset::TruthPose& p, TimestampNs at) { return p.stamp_ns < at; });
  if (after == poses.begin() || after == poses.end()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->stamp_ns - before->stamp_ns > kNsPerSecond / 20) return std::nullopt;
  const double share =
      to_seconds(stamp_ns - before->stamp_ns) / to_seconds(after->stamp_ns - before->stamp_ns);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      before->world_from_sensor.slerp(share, after->world_from_sensor).toRotationMatrix();
  pose.translation() = before->position_m + share * (after->position_m - before->position_m);
  return pose;
}

std::optional<TrueMotion> relative_truth(const std::vector<dataset::TruthPose>& poses,
                                         TimestampNs from_ns, TimestampNs to_ns) {
  const auto from = pose_at(poses, from_ns);
  const auto to = pose_at(poses, to_ns);
  if (!from || !to) return std::nullopt;
  const Eigen::Isometry3d motion = from->inverse() * *to;
  return TrueMotion{motion.translation(), Eigen::Quaterniond(motion.linear()).normalized()};
}

std::optional<double> speed_at(const std::vector<dataset::TruthPose>& poses, TimestampNs stamp_ns) {
  constexpr TimestampNs kHalf = 25'000'000;
  const auto motion = relative_truth(poses, stamp_ns - kHalf, stamp_ns + kHalf);
  if (!motion) return std::nullopt;
  return motion->translation_m.norm() / to_seconds(2 * kHalf);
}

}  // namespace vpdr::bench
