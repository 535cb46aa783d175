#include "calibration/ellipsoid_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/median.hpp"

namespace vpdr::calibration {
namespace {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr double kTukeyLimit = 4.685;  ///< 95 % efficiency for normal errors
constexpr int kRounds = 12;
constexpr int kStepsPerRound = 10;

/// xx yy zz xy xz yz of E, then the bias in radii.
LinearCorrection correction_of(const Vector9d& p, const Sphere& start) {
  LinearCorrection out;
  out.matrix << 1.0 + p[0], p[3], p[4], p[3], 1.0 + p[1], p[5], p[4], p[5], 1.0 + p[2];
  out.bias = start.centre + start.radius * p.tail<3>();
  return out;
}

/// Derivative of |A (v - b)| / radius by the parameters, with u = A (v - b) / radius and
/// w = (v - b) / radius: d|u| = u^T (dE w - A db) / |u|.
Vector9d gradient(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& u,
                  const Eigen::Vector3d& w) {
  const Eigen::Vector3d n = u.normalized();
  Vector9d g;
  g << n.x() * w.x(), n.y() * w.y(), n.z() * w.z(), n.x() * w.y() + n.y() * w.x(),
      n.x() * w.z() + n.z() * w.x(), n.y() * w.z() + n.z() * w.y(), -(matrix.transpose() * n);
  return g;
}

class Problem {
 public:
  Problem(std::span<const LengthSample> samples, const Sphere& start, const EllipsoidConfig& config)
      : samples_(samples), start_(start), weights_(samples.size(), 1.0) {
    information_ << Eigen::Vector3d::Constant(1.0 / square(config.scale_sigma)),
        Eigen::Vector3d::Constant(1.0 / square(config.skew_sigma)),
        Eigen::Vector3d::Constant(1.0 / square(config.bias_sigma));
  }

  /// Weighted errors of the length, in their deviations.
  [[nodiscard]] std::vector<double> errors() const {
    const LinearCorrection correction = correction_of(parameters_, start_);
    std::vector<double> out;
    out.reserve(samples_.size());
    for (const LengthSample& s : samples_) {
      out.push_back((correction.apply(s.value).norm() - start_.radius) / s.sigma);
    }
    return out;
  }

  /// Tukey's weights for errors beyond `limit` deviations.
  void weigh(double limit) {
    const std::vector<double> error = errors();
    for (std::size_t i = 0; i < error.size(); ++i) {
      const double share = square(error[i] / limit);
      weights_[i] = share < 1.0 ? square(1.0 - share) : 0.0;
    }
  }

  void minimise() {
    double damping = 1e-6;
    double present = cost(parameters_);
    for (int step = 0; step < kStepsPerRound; ++step) {
      Vector9d slope;
      const Matrix9d normal = normal_equations(slope);
      Matrix9d damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Vector9d trial = parameters_ - damped.ldlt().solve(slope);
      const double next = cost(trial);
      if (next > present || !std::isfinite(next)) {
        damping *= 10.0;
        continue;
      }
      const bool settled = present - next <= 1e-12 * present;
      parameters_ = trial;
      present = next;
      damping *= 0.1;
      if (settled) break;
    }
  }

  /// Covariance of the parameters; errors larger than expected count as larger noise.
  [[nodiscard]] Matrix9d covariance() const {
    Vector9d slope;
    Matrix9d normal = normal_equations(slope);
    normal -= Matrix9d(information_.asDiagonal());
    const std::vector<double> error = errors();
    double chi2 = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      chi2 += weights_[i] * square(error[i]);
      count += weights_[i];
    }
    normal /= std::max(1.0, chi2 / std::max(1.0, count - 9.0));
    normal += Matrix9d(information_.asDiagonal());
    return normal.ldlt().solve(Matrix9d::Identity());
  }

  [[nodiscard]] const Vector9d& parameters() const { return parameters_; }
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }

 private:
  static double square(double x) { return x * x; }

  [[nodiscard]] double cost(const Vector9d& parameters) const {
    const LinearCorrection correction = correction_of(parameters, start_);
    double sum = (parameters.array().square() * information_.array()).sum();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const LengthSample& s = samples_[i];
      sum += weights_[i] * square((correction.apply(s.value).norm() - start_.radius) / s.sigma);
    }
    return sum;
  }

  Matrix9d normal_equations(Vector9d& slope) const {
    const LinearCorrection correction = correction_of(parameters_, start_);
    Matrix9d normal = information_.asDiagonal();
    slope = information_.cwiseProduct(parameters_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const LengthSample& s = samples_[i];
      const Eigen::Vector3d w = (s.value - correction.bias) / start_.radius;
      const Eigen::Vector3d u = correction.matrix * w;
      if (weights_[i] == 0.0 || u.isZero()) continue;
      const double precision = weights_[i] * square(start_.radius / s.sigma);
      const Vector9d g = gradient(correction.matrix, u, w);
      normal.noalias() += precision * g * g.transpose();
      slope.noalias() += precision * (u.norm() - 1.0) * g;
    }
    return normal;
  }

  std::span<const LengthSample> samples_;
  Sphere start_;
  Vector9d information_;  ///< of the prior
  Vector9d parameters_ = Vector9d::Zero();
  std::vector<double> weights_;
};

/// The direction in which the corrected length is known least, on a lattice of the sphere.
void find_worst_direction(const Problem& problem, const Sphere& start, EllipsoidFit& fit) {
  const Matrix9d covariance = problem.covariance();
  const LinearCorrection correction = correction_of(problem.parameters(), start);
  const Eigen::Matrix3d inverse = correction.matrix.inverse();
  double worst = -1.0;
  for (int i = 0; i < 26; ++i) {
    const int cell = i < 13 ? i : i + 1;  // 3 x 3 x 3 without the middle
    const Eigen::Vector3i steps(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
    const Eigen::Vector3d u = steps.cast<double>().normalized();
    const Vector9d g = gradient(correction.matrix, u, inverse * u);
    const double variance = g.dot(covariance * g);
    if (variance <= worst) continue;
    worst = variance;
    fit.worst_direction = u;
  }
  fit.worst_sigma = std::sqrt(worst);
}

/// Middle of each coordinate's range, without the farthest tenths: far points do not move it.
Sphere rough_sphere(const std::vector<Eigen::Vector3d>& points) {
  Sphere sphere;
  if (points.empty()) return sphere;
  const std::size_t tenth = points.size() / 10;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& p : points) values.push_back(p[axis]);
    std::sort(values.begin(), values.end());
    sphere.centre[axis] = 0.5 * (values[tenth] + values[values.size() - 1 - tenth]);
  }
  std::vector<double> distances;
  for (const auto& p : points) distances.push_back((p - sphere.centre).norm());
  sphere.radius = median(distances);
  return sphere;
}

/// |p|^2 = 2 c^T p + (r^2 - |c|^2) is linear in c and the bracket; p is taken from the points'
/// mean.
Sphere least_squares_sphere(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::MatrixXd lhs(static_cast<Eigen::Index>(points.size()), 4);
  Eigen::VectorXd rhs(lhs.rows());
  for (Eigen::Index i = 0; i < lhs.rows(); ++i) {
    const Eigen::Vector3d p = points[static_cast<std::size_t>(i)] - mean;
    lhs.row(i) << 2.0 * p.transpose(), 1.0;
    rhs[i] = p.squaredNorm();
  }
  const Eigen::Vector4d x = lhs.colPivHouseholderQr().solve(rhs);
  return {mean + x.head<3>(), std::sqrt(std::max(0.0, x[3] + x.head<3>().squaredNorm()))};
}

double length_error(const Eigen::Vector3d& point, const Sphere& sphere) {
  return std::abs((point - sphere.centre).norm() - sphere.radius);
}

}  // namespace

EllipsoidFit fit_ellipsoid(std::span<const LengthSample> samples, const Sphere& start,
                           const EllipsoidConfig& config) {
  Problem problem(samples, start, config);
  problem.minimise();
  double limit = 0.0;
  for (const double error : problem.errors()) limit = std::max(limit, 2.0 * std::abs(error));
  for (int round = 0; round < kRounds && !samples.empty(); ++round) {
    std::vector<double> sizes = problem.errors();
    for (double& size : sizes) size = std::abs(size);
    const double deviation = std::max(1.0, kDeviationPerMedian * median(sizes));
    limit = std::max(0.5 * limit, kTukeyLimit * deviation);
    problem.weigh(limit);
    problem.minimise();
  }

  EllipsoidFit fit;
  fit.correction = correction_of(problem.parameters(), start);
  find_worst_direction(problem, start, fit);
  double all = 0.0;
  double counted = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double error = fit.correction.apply(samples[i].value).norm() / start.radius - 1.0;
    all += error * error;
    if (problem.weights()[i] == 0.0) continue;
    counted += error * error;
    ++count;
  }
  const auto total = static_cast<double>(std::max<std::size_t>(1, samples.size()));
  fit.rms_all = std::sqrt(all / total);
  fit.rms = std::sqrt(counted / static_cast<double>(std::max<std::size_t>(1, count)));
  fit.outliers = 1.0 - static_cast<double>(count) / total;
  return fit;
}

Sphere fit_sphere(std::span<const LengthSample> samples) {
  std::vector<Eigen::Vector3d> points;
  for (const LengthSample& s : samples) points.push_back(s.value);
  Sphere sphere = rough_sphere(points);
  for (int round = 0; round < 4; ++round) {
    std::vector<double> errors;
    for (const auto& p : points) errors.push_back(length_error(p, sphere));
    const double limit = std::max(4.0 * kDeviationPerMedian * median(errors), 1e-9 * sphere.radius);
    std::erase_if(points,
                  [&](const Eigen::Vector3d& p) { return length_error(p, sphere) > limit; });
    if (points.size() < 4) break;
    sphere = least_squares_sphere(points);
  }
  return sphere;
}

}  // namespace vpdr::calibration
