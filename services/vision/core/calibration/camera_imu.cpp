#include "vision/core/calibration/camera_imu.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr double kOffsetDerivativeS = 0.002;
constexpr double kFastestFactor = 1.3;
constexpr double kTukey = 4.685;                // 95 % efficiency for normal residuals
constexpr double kSigmaOfMedian = 1.0 / 1.538;  // median norm of three standard normals

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// Turns by the gyroscope between any two instants.
class Gyro {
 public:
  Gyro(const std::vector<ImuSample>& imu, double max_gap_s) : imu_(imu), max_gap_s_(max_gap_s) {}

  /// Rotation vector, earlier from later; nothing outside the samples or over a gap.
  [[nodiscard]] std::optional<Eigen::Vector3d> turn(double start_s, double end_s,
                                                    const Eigen::Vector3d& bias) const {
    const auto first =
        std::upper_bound(imu_.begin(), imu_.end(), start_s,
                         [&](double t, const ImuSample& s) { return t < seconds(s.stamp_ns); });
    if (first == imu_.begin() || first == imu_.end()) return std::nullopt;
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    double from = start_s;
    for (auto after = first; from < end_s; ++after) {
      if (after == imu_.end()) return std::nullopt;
      const ImuSample& a = *std::prev(after);
      const double ta = seconds(a.stamp_ns);
      const double tb = seconds(after->stamp_ns);
      if (tb - ta > max_gap_s_ || tb <= ta) return std::nullopt;
      const double to = std::min(tb, end_s);
      const double middle = (0.5 * (from + to) - ta) / (tb - ta);
      const Eigen::Vector3d rate =
          a.angular_velocity_radps +
          middle * (after->angular_velocity_radps - a.angular_velocity_radps);
      q = q * exp_rotation((rate - bias) * (to - from));
      from = to;
    }
    return log_rotation(q);
  }

  [[nodiscard]] double seconds(TimestampNs t) const {
    return to_seconds(t - imu_.front().stamp_ns);
  }

 private:
  const std::vector<ImuSample>& imu_;
  double max_gap_s_;
};

// Without the turns that are faster than the gyroscope ever measured: bad frames.
std::vector<VisualTurn> possible_turns(const std::vector<VisualTurn>& turns,
                                       const std::vector<ImuSample>& imu) {
  double fastest = 0.0;
  for (const ImuSample& s : imu) fastest = std::max(fastest, s.angular_velocity_radps.norm());
  std::vector<VisualTurn> out;
  for (const VisualTurn& t : turns) {
    const double rate = t.rotation_rad.norm() / to_seconds(t.end_ns - t.start_ns);
    if (rate <= kFastestFactor * fastest) out.push_back(t);
  }
  return out;
}

struct Pair {
  Eigen::Vector3d camera;
  Eigen::Vector3d gyro;
  double dt_s;
};

std::vector<Pair> pairs_at(const std::vector<VisualTurn>& turns, const Gyro& gyro, double offset_s,
                           const Eigen::Vector3d& bias) {
  std::vector<Pair> pairs;
  for (const VisualTurn& t : turns) {
    const double start = gyro.seconds(t.start_ns);
    const double end = gyro.seconds(t.end_ns);
    const auto measured = gyro.turn(start + offset_s, end + offset_s, bias);
    if (measured && end > start) pairs.push_back({t.rotation_rad, *measured, end - start});
  }
  return pairs;
}

double correlation(const std::vector<Pair>& pairs) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (const Pair& p : pairs) {
    const double x = p.camera.norm() / p.dt_s;
    const double y = p.gyro.norm() / p.dt_s;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
    syy += y * y;
  }
  const auto n = static_cast<double>(pairs.size());
  const double spread = (sxx - sx * sx / n) * (syy - sy * sy / n);
  return spread > 0.0 ? (sxy - sx * sy / n) / std::sqrt(spread) : 0.0;
}

struct Offset {
  double s = 0.0;
  double correlation = -1.0;
};

Offset coarse_offset(const std::vector<VisualTurn>& turns, const Gyro& gyro,
                     const CameraImuConfig& config) {
  Offset best;
  const int steps = static_cast<int>(config.max_offset_s / config.offset_step_s);
  for (int i = -steps; i <= steps; ++i) {
    const double offset = i * config.offset_step_s;
    const std::vector<Pair> pairs = pairs_at(turns, gyro, offset, Eigen::Vector3d::Zero());
    if (2 * pairs.size() < turns.size() || pairs.size() < config.min_turns) continue;
    const double c = correlation(pairs);
    if (c > best.correlation) best = {offset, c};
  }
  return best;
}

// Second largest RMS rate over the axes: one axis alone leaves the turn about it unknown.
double second_axis_rate(const std::vector<Pair>& pairs) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Pair& p : pairs) {
    const Eigen::Vector3d rate = p.gyro / p.dt_s;
    scatter += rate * rate.transpose() / static_cast<double>(pairs.size());
  }
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[1]));
}

// Gyro rate = R camera rate + bias.
void align(const std::vector<Pair>& pairs, CameraImuCalibration& c) {
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();
  const auto n = static_cast<double>(pairs.size());
  for (const Pair& p : pairs) {
    camera += p.camera / p.dt_s / n;
    gyro += p.gyro / p.dt_s / n;
  }
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
  for (const Pair& p : pairs) {
    cross += (p.gyro / p.dt_s - gyro) * (p.camera / p.dt_s - camera).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  c.imu_from_camera = u * svd.matrixV().transpose();
  c.gyro_bias_radps = gyro - c.imu_from_camera * camera;
}

struct Equations {
  Matrix7d information = Matrix7d::Identity() * 1e-9;
  Vector7d gradient = Vector7d::Zero();
  double weighted_squares = 0.0;
  double weights = 0.0;
  std::size_t used = 0;
  std::size_t outliers = 0;
};

// Residual: the gyroscope's turn minus the camera's, in the IMU's axes.
struct Row {
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, 7> jacobian;
};

std::vector<Row> rows_of(const std::vector<VisualTurn>& turns, const Gyro& gyro,
                         const CameraImuCalibration& c) {
  std::vector<Row> rows;
  for (const VisualTurn& t : turns) {
    const double start = gyro.seconds(t.start_ns) + c.timeshift_s;
    const double end = gyro.seconds(t.end_ns) + c.timeshift_s;
    const auto turn = gyro.turn(start, end, c.gyro_bias_radps);
    const double e = kOffsetDerivativeS;
    const auto before = gyro.turn(start - e, end - e, c.gyro_bias_radps);
    const auto after = gyro.turn(start + e, end + e, c.gyro_bias_radps);
    if (!turn || !before || !after) continue;
    const Eigen::Vector3d seen = c.imu_from_camera * t.rotation_rad;
    Row row;
    row.residual = *turn - seen;
    row.jacobian << cross_matrix(seen), -(end - start) * Eigen::Matrix3d::Identity(),
        (*after - *before) / (2.0 * e);
    rows.push_back(row);
  }
  return rows;
}

double robust_sigma(const std::vector<Row>& rows) {
  std::vector<double> norms;
  for (const Row& row : rows) norms.push_back(row.residual.norm());
  const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
  std::nth_element(norms.begin(), middle, norms.end());
  return std::max(1e-6, *middle * kSigmaOfMedian);
}

Equations equations_of(const std::vector<Row>& rows) {
  Equations e;
  const double limit = kTukey * robust_sigma(rows);
  for (const Row& row : rows) {
    const double share = row.residual.squaredNorm() / (3.0 * limit * limit);
    if (share >= 1.0) {
      ++e.outliers;
      continue;
    }
    const double w = (1.0 - share) * (1.0 - share);
    e.information += w * row.jacobian.transpose() * row.jacobian;
    e.gradient += w * row.jacobian.transpose() * row.residual;
    e.weighted_squares += w * row.residual.squaredNorm();
    e.weights += w;
    ++e.used;
  }
  return e;
}

void refine(const std::vector<VisualTurn>& turns, const Gyro& gyro, const CameraImuConfig& config,
            CameraImuCalibration& c) {
  for (int i = 0; i <= config.iterations; ++i) {
    const Equations e = equations_of(rows_of(turns, gyro, c));
    const Matrix7d inverse = e.information.inverse();
    const double variance = e.weighted_squares / std::max(1.0, 3.0 * e.weights - 7.0);
    c.rotation_sigma_rad = (variance * inverse.diagonal().head<3>()).cwiseMax(0.0).cwiseSqrt();
    c.timeshift_sigma_s = std::sqrt(std::max(0.0, variance * inverse(6, 6)));
    c.rms_rad = std::sqrt(e.weighted_squares / std::max(1e-9, e.weights));
    c.turns = e.used;
    c.outliers = e.outliers;
    if (i == config.iterations) break;
    const Vector7d step = -inverse * e.gradient;
    c.imu_from_camera = exp_rotation(step.head<3>()).toRotationMatrix() * c.imu_from_camera;
    c.gyro_bias_radps += step.segment<3>(3);
    c.timeshift_s += step[6];
  }
}

}  // namespace

Result<CameraImuCalibration> align_camera_imu(const std::vector<VisualTurn>& turns,
                                              const std::vector<ImuSample>& imu,
                                              const CameraImuConfig& config) {
  if (imu.size() < 2 || turns.size() < config.min_turns) {
    return Error{"only " + std::to_string(turns.size()) + " turns between frames and " +
                 std::to_string(imu.size()) +
                 " inertial samples: wave both for half a minute where there is much to see"};
  }
  const Gyro gyro(imu, config.max_gap_s);
  const std::vector<VisualTurn> possible = possible_turns(turns, imu);
  const Offset offset = coarse_offset(possible, gyro, config);
  if (offset.correlation < config.min_correlation) {
    return Error{"camera and gyroscope do not turn alike at any time offset up to " +
                 std::to_string(config.max_offset_s) +
                 " s: are they fixed to each other, and on one clock?"};
  }
  CameraImuCalibration c;
  c.timeshift_s = offset.s;
  const std::vector<Pair> pairs = pairs_at(possible, gyro, offset.s, Eigen::Vector3d::Zero());
  if (second_axis_rate(pairs) < config.min_rate_radps) {
    return Error{"turned about one axis only: turn the camera about all three, back and forth"};
  }
  align(pairs, c);
  refine(possible, gyro, config, c);
  c.outliers += turns.size() - possible.size();
  return c;
}

}  // namespace vpdr::vision
