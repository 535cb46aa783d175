#pragma once
// Calibration of a sensor whose true reading has one length in every direction: gravity, the
// magnetic field. Readings lie on an ellipsoid; the fit finds the map that makes it a sphere.
//
// Model: |(I + E) (v - b)| = radius with E symmetric: scale and skew of the axes, with no axis
// preferred. E and b have a prior (how bad such sensors are), so that the fit does not run away
// where directions are missing; the covariance then tells which are. Minimised by
// Levenberg-Marquardt with Tukey's weights, whose limit narrows from round to round: readings that
// fit no ellipsoid (a jolt, a passing magnet) do not count. Pure; reentrant.
#include <Eigen/Core>
#include <span>

#include "calibration/linear_correction.hpp"

namespace vpdr::calibration {

/// One reading and the deviation expected of its length.
struct LengthSample {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  double sigma = 1.0;
};

/// Centre and radius of a sphere.
struct Sphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

struct EllipsoidConfig {
  double scale_sigma = 0.05;  ///< expected size of E's diagonal
  double skew_sigma = 0.02;   ///< and of its other elements
  double bias_sigma = 0.3;    ///< of the bias about the starting centre, in radii
};

/// What the readings say of the sensor. Relative numbers are shares of the radius.
struct EllipsoidFit {
  LinearCorrection correction;
  double rms = 0.0;       ///< relative length error of the readings that count
  double rms_all = 0.0;   ///< of all of them
  double outliers = 0.0;  ///< share of the readings that do not count
  /// Deviation of the corrected length in the direction that is known least, and that direction
  /// (corrected axes, unit length): where readings are missing.
  double worst_sigma = 0.0;
  Eigen::Vector3d worst_direction = Eigen::Vector3d::UnitZ();
};

/// The fit, begun at `start`; the corrected length is start.radius. Any number of readings gives a
/// fit; too few of them, or too much alike, give one whose worst_sigma is large.
EllipsoidFit fit_ellipsoid(std::span<const LengthSample> samples, const Sphere& start,
                           const EllipsoidConfig& config);

/// The sphere nearest to the readings by linear least squares, those far from it left out. Radius 0
/// where there are none.
Sphere fit_sphere(std::span<const LengthSample> samples);

}  // namespace vpdr::calibration
