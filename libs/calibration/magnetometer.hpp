#pragma once
// Calibration of a magnetometer: turned every way in one place, it reads the field's length. Hard
// iron (magnetised parts of the board) moves the readings, soft iron (iron parts) and unequal axes
// deform them.
#include <optional>

#include "calibration/ellipsoid_fit.hpp"
#include "calibration/sphere_coverage.hpp"
#include "core/result.hpp"
#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

struct MagnetometerConfig {
  double thin_angle_rad = 0.04;    ///< readings nearer to one another count once
  double smooth_s = 0.06;          ///< readings are means over this time: their noise is no field
  double smooth_angle_rad = 0.08;  ///< of those no further apart: the mean over an arc is too short
  double noise = 0.01;             ///< expected error of a length, share of the field
  double shape_sigma = 0.2;
  double min_coverage = 0.6;       ///< share of the sphere's cells
  double max_length_sigma = 0.01;  ///< of the field, in the direction known least
  double min_field_ut = 15.0;      ///< anywhere on Earth it is 22 to 67; indoors, with some room
  double max_field_ut = 100.0;
};

struct MagnetometerCalibration {
  LinearCorrection correction;  ///< microtesla; keeps the volume of the readings' ellipsoid
  double field_ut = 0.0;
  double coverage = 0.0;
  double rms_before = 0.0;  ///< of the readings' length about its mean, share of it
  double rms = 0.0;         ///< after: of the readings that count
  double rms_all = 0.0;     ///< of all
  double outliers = 0.0;    ///< share
  double worst_sigma = 0.0;
};

/// Refuses poor coverage, telling which way to turn the board, and a field that is not the Earth's.
Result<MagnetometerCalibration> calibrate_magnetometer(const std::vector<TimedVector>& field,
                                                       const MagnetometerConfig& config = {});

/// One mean reading for each direction seen from `centre`, in the order of time.
std::vector<TimedVector> thin_out(const std::vector<TimedVector>& field,
                                  const Eigen::Vector3d& centre, const MagnetometerConfig& config);

/// Angle of the field below the horizon, and its scatter.
struct Dip {
  double angle_rad = 0.0;
  double sigma_rad = 0.0;
  std::size_t pairs = 0;
};

/// From corrected readings of field and force, in one set of axes; where the board accelerates the
/// median does not mind. nullopt without pairs.
std::optional<Dip> measure_dip(const std::vector<TimedVector>& field,
                               const std::vector<TimedVector>& force);

}  // namespace vpdr::calibration
