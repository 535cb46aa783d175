#pragma once
// True motion out of a reference: poses between those recorded, motion and speed between instants.
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/time.hpp"
#include "dataset/recording.hpp"

namespace vpdr::bench {

/// A pose file as the TUM benchmark has it: seconds, position, quaternion x y z w.
std::vector<dataset::TruthPose> read_tum(const std::filesystem::path& file);

struct TrueMotion {
  Eigen::Vector3d translation_m;
  Eigen::Quaterniond rotation;
};
std::optional<Eigen::Isometry3d> pose_at(const std::vector<dataset::TruthPose>& poses,
                                         TimestampNs stamp_ns);
std::optional<TrueMotion> relative_truth(const std::vector<dataset::TruthPose>& poses,
                                         TimestampNs from_ns, TimestampNs to_ns);
std::optional<double> speed_at(const std::vector<dataset::TruthPose>& poses, TimestampNs stamp_ns);

}  // namespace vpdr::bench
