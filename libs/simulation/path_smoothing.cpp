#include "simulation/path_smoothing.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kReach = 3.0;  // standard deviations of a window that are looked at
constexpr int kRounds = 4;      // of finding out which poses are far off

/// Weight of a pose that is `off` standard deviations away (Cauchy).
double trust(double off) { return 1.0 / (1.0 + off * off); }

/// Attitude by the gyroscope alone, from the first sample on, at each of `stamps` (rising, within
/// the samples).
std::vector<Quaterniond> integrate(const std::vector<ImuSample>& imu,
                                   const std::vector<PathPose>& poses) {
  std::vector<Quaterniond> attitudes;
  Quaterniond q = Quaterniond::Identity();
  TimestampNs at = imu.front().stamp_ns;
  std::size_t k = 0;
  for (const PathPose& pose : poses) {
    while (at < pose.stamp_ns) {
      while (imu[k + 1].stamp_ns <= at) ++k;
      const TimestampNs until = std::min(imu[k + 1].stamp_ns, pose.stamp_ns);
      // The rate half-way, on the line between the two samples.
      const double share = to_seconds((at - imu[k].stamp_ns) + (until - imu[k].stamp_ns)) * 0.5 /
                           to_seconds(imu[k + 1].stamp_ns - imu[k].stamp_ns);
      const Vector3d rate =
          imu[k].angular_velocity_radps +
          share * (imu[k + 1].angular_velocity_radps - imu[k].angular_velocity_radps);
      q = (q * exp_rotation(to_seconds(until - at) * rate)).normalized();
      at = until;
    }
    attitudes.push_back(q);
  }
  return attitudes;
}

/// The poses within a window around one of them, with their weight by distance in time.
struct Window {
  std::size_t first = 0, last = 0;  ///< last: one beyond

  void move(const std::vector<PathPose>& poses, std::size_t around, double sigma_s) {
    const TimestampNs reach = to_ns(kReach * sigma_s);
    while (poses[first].stamp_ns < poses[around].stamp_ns - reach) ++first;
    last = std::max(last, around + 1);
    while (last < poses.size() && poses[last].stamp_ns <= poses[around].stamp_ns + reach) ++last;
  }
};

double gaussian(double t_s, double sigma_s) {
  return std::exp(-0.5 * t_s * t_s / (sigma_s * sigma_s));
}

/// What turns the gyroscope's attitudes into those of the poses, world axes, pose by pose.
std::vector<Quaterniond> differences(const std::vector<PathPose>& poses,
                                     const std::vector<Quaterniond>& by_gyro) {
  std::vector<Quaterniond> off_by;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    off_by.push_back((poses[i].world_from_body * by_gyro[i].conjugate()).normalized());
  }
  return off_by;
}

/// The mean of the differences around one pose, starting from what it was around the pose before:
/// a run of mistaken poses does not draw it along.
Quaterniond local_mean(const std::vector<PathPose>& poses, const std::vector<Quaterniond>& off_by,
                       const Window& window, std::size_t around, const Quaterniond& before,
                       const SmoothingOptions& o) {
  Quaterniond mean = before;
  for (int round = 0; round < kRounds; ++round) {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    for (std::size_t i = window.first; i < window.last; ++i) {
      const Vector3d off = log_rotation((off_by[i] * mean.conjugate()).normalized());
      const double t_s = to_seconds(poses[i].stamp_ns - poses[around].stamp_ns);
      const double weight =
          gaussian(t_s, o.attitude_window_s) * trust(off.norm() / o.attitude_noise_rad);
      sum += weight * off;
      weights += weight;
    }
    mean = (exp_rotation(sum / weights) * mean).normalized();
  }
  return mean;
}

/// `trusts`: of each pose, by its attitude: a mistaken one is mistaken in both.
Vector3d position(const std::vector<PathPose>& poses, const std::vector<double>& trusts,
                  const Window& window, std::size_t around, const SmoothingOptions& o) {
  if (window.last - window.first < 5) return poses[around].position_m;
  Matrix3d parabola = Matrix3d::Zero();  // rows: constant, slope and bend; columns: x y z
  for (int round = 0; round < kRounds; ++round) {
    Matrix3d normal = 1e-12 * Matrix3d::Identity(), right = Matrix3d::Zero();
    for (std::size_t i = window.first; i < window.last; ++i) {
      const double t = to_seconds(poses[i].stamp_ns - poses[around].stamp_ns) / o.position_window_s;
      const Vector3d powers(1.0, t, t * t);
      const double off =
          round == 0 ? 0.0 : (poses[i].position_m - parabola.transpose() * powers).norm();
      const double weight = gaussian(t, 1.0) * trusts[i] * trust(off / o.position_noise_m);
      normal += weight * powers * powers.transpose();
      right += weight * powers * poses[i].position_m.transpose();
    }
    parabola = normal.ldlt().solve(right);
  }
  return parabola.row(0).transpose();
}

}  // namespace

ReferencePath smooth_with_gyroscope(const ReferencePath& path, const std::vector<ImuSample>& imu,
                                    const SmoothingOptions& options) {
  if (imu.size() < 2 || !imu.front().has_angular_velocity) return path;
  std::vector<PathPose> poses;
  for (const PathPose& pose : path.poses()) {
    if (pose.stamp_ns >= imu.front().stamp_ns && pose.stamp_ns <= imu.back().stamp_ns) {
      poses.push_back(pose);
    }
  }
  if (poses.size() < 2) return path;
  const std::vector<Quaterniond> by_gyro = integrate(imu, poses);
  const std::vector<Quaterniond> off_by = differences(poses, by_gyro);
  std::vector<PathPose> smooth = poses;
  std::vector<double> trusts;
  Window near;
  Quaterniond mean = off_by.front();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    near.move(poses, i, options.attitude_window_s);
    mean = local_mean(poses, off_by, near, i, mean, options);
    smooth[i].world_from_body = (mean * by_gyro[i]).normalized();
    trusts.push_back(trust(off_by[i].angularDistance(mean) / options.attitude_noise_rad));
  }
  near = {};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    near.move(poses, i, options.position_window_s);
    smooth[i].position_m = position(poses, trusts, near, i, options);
  }
  return ReferencePath(smooth);
}

}  // namespace vpdr::simulation
