#include "calibration/magnetometer.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "calibration/median.hpp"
#include "calibration/window.hpp"

namespace vpdr::calibration {
namespace {

constexpr TimestampNs kDipWindowNs = 100'000'000;

double scatter_before(const std::vector<TimedVector>& field) {
  double mean = 0.0;
  for (const TimedVector& f : field) mean += f.value.norm() / static_cast<double>(field.size());
  double sum = 0.0;
  for (const TimedVector& f : field) sum += std::pow(f.value.norm() / mean - 1.0, 2);
  return std::sqrt(sum / static_cast<double>(field.size()));
}

double coverage_of(const std::vector<TimedVector>& field, const LinearCorrection& correction,
                   Eigen::Vector3d& hole) {
  SphereCoverage coverage;
  for (const TimedVector& f : field) coverage.add(correction.apply(f.value));
  hole = coverage.largest_hole();
  return coverage.share();
}

/// Mean of the readings that point nearly the way of `reading`, itself among them.
Eigen::Vector3d mean_alike(std::span<const TimedVector> readings, const Eigen::Vector3d& reading,
                           const Eigen::Vector3d& centre, double angle_rad) {
  const Eigen::Vector3d direction = (reading - centre).normalized();
  const double cosine = std::cos(angle_rad);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const TimedVector& r : readings) {
    if ((r.value - centre).normalized().dot(direction) < cosine) continue;
    sum += r.value;
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : reading;
}

Error poor_coverage(double coverage, const Eigen::Vector3d& direction) {
  std::ostringstream text;
  text
      << std::fixed << std::setprecision(0) << "the board was turned through " << 100.0 * coverage
      << " % of all directions; turn it on, slowly and every way, until the field has also pointed "
         "along "
      << direction_name(direction) << " of the board";
  return Error{text.str()};
}

}  // namespace

std::vector<TimedVector> thin_out(const std::vector<TimedVector>& field,
                                  const Eigen::Vector3d& centre, const MagnetometerConfig& config) {
  std::vector<TimedVector> out;
  const double cosine = std::cos(config.thin_angle_rad);
  const TimestampNs half_ns = to_ns(0.5 * config.smooth_s);
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (const TimedVector& f : field) {
    const auto around = window_of(field, f.stamp_ns - half_ns, f.stamp_ns + half_ns + 1);
    const TimedVector mean{f.stamp_ns,
                           mean_alike(around, f.value, centre, config.smooth_angle_rad)};
    const Eigen::Vector3d direction = (mean.value - centre).normalized();
    if (direction.dot(last) > cosine) continue;
    last = direction;
    out.push_back(mean);
  }
  return out;
}

Result<MagnetometerCalibration> calibrate_magnetometer(const std::vector<TimedVector>& field,
                                                       const MagnetometerConfig& config) {
  std::vector<LengthSample> samples;
  for (const TimedVector& f : field) samples.push_back({f.value, 1.0});
  Sphere sphere = fit_sphere(samples);
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
    return Error{"the board did not turn; turn it slowly, every way, for half a minute"};
  }
  const std::vector<TimedVector> thinned = thin_out(field, sphere.centre, config);
  samples.clear();
  for (const TimedVector& f : thinned) samples.push_back({f.value, config.noise * sphere.radius});
  sphere = fit_sphere(samples);
  for (LengthSample& s : samples) s.sigma = config.noise * sphere.radius;

  EllipsoidConfig fit_config;
  fit_config.scale_sigma = config.shape_sigma;
  fit_config.skew_sigma = config.shape_sigma;
  fit_config.bias_sigma = 1.0;
  const EllipsoidFit fit = fit_ellipsoid(samples, sphere, fit_config);
  MagnetometerCalibration out;
  Eigen::Vector3d hole;
  out.coverage = coverage_of(thinned, fit.correction, hole);
  if (out.coverage < config.min_coverage) return poor_coverage(out.coverage, hole);
  if (fit.worst_sigma > config.max_length_sigma) {
    return poor_coverage(out.coverage, fit.worst_direction);
  }
  // The fit's sphere may have any size; the readings' own mean sensitivity is kept.
  const double shrink = std::cbrt(fit.correction.matrix.determinant());
  out.correction = {fit.correction.matrix / shrink, fit.correction.bias};
  out.field_ut = sphere.radius / shrink;
  out.rms_before = scatter_before(thinned);
  out.rms = fit.rms;
  out.rms_all = fit.rms_all;
  out.outliers = fit.outliers;
  out.worst_sigma = fit.worst_sigma;
  if (out.field_ut < config.min_field_ut || out.field_ut > config.max_field_ut) {
    return Error{"the field is " + std::to_string(out.field_ut) +
                 " uT: the Earth's is 22 to 67; check the unit of the readings, and keep away from "
                 "magnets and motors"};
  }
  return out;
}

std::optional<Dip> measure_dip(const std::vector<TimedVector>& field,
                               const std::vector<TimedVector>& force) {
  std::vector<double> angles;
  for (const TimedVector& f : field) {
    const auto around =
        moments_of(window_of(force, f.stamp_ns - kDipWindowNs / 2, f.stamp_ns + kDipWindowNs / 2));
    if (around.count == 0 || around.mean.isZero() || f.value.isZero()) continue;
    const double sine = -f.value.normalized().dot(around.mean.normalized());
    angles.push_back(std::asin(std::clamp(sine, -1.0, 1.0)));
  }
  if (angles.empty()) return std::nullopt;
  Dip dip;
  dip.pairs = angles.size();
  dip.angle_rad = median(angles);
  for (double& angle : angles) angle = std::abs(angle - dip.angle_rad);
  dip.sigma_rad = kDeviationPerMedian * median(angles);
  return dip;
}

}  // namespace vpdr::calibration
