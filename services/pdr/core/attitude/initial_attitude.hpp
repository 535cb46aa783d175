#pragma once
// First attitude from one accelerometer and one magnetometer reading: the vision-aided PDR survey's
// tilt equations (S1.4: 2-8, 2-9, 2-10) and heading equations (S1.5: 2-11, 2-12, 2-13).
//
// The survey's own axes: x right, y forward, z up; pitch about x, roll about y, yaw about z,
// rotated in the order Z, X, Y from the world to the body. Its f is gravity, pointing down: the
// negative of what an accelerometer reads at rest. Yaw is counter-clockwise from magnetic north,
// [0, 2 pi). The functions at the end speak vpdr's language: body forward-left-up, world ENU.
// Pure functions, thread-safe, no errors: a zero vector gives zero angles.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::pdr {

/// Pitch and roll in the survey's axes, both in [-pi/2, pi/2], rad.
struct SurveyTilt {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

/// (2-8): gravity in the survey's body axes, [g sin r cos p, -g sin p, -g cos r cos p].
Eigen::Vector3d survey_gravity(const SurveyTilt& tilt, double gravity_mps2);

/// (2-9) pitch = asin(-f_y / |f|); (2-10) roll = -atan(f_x / f_z) where |f_z| >= 0.1 g, else
/// asin(f_x / (|f| cos pitch)). `gravity_mps2` is gravity f (down), not the accelerometer reading.
SurveyTilt survey_tilt(const Eigen::Vector3d& gravity_mps2);

/// (2-11): the measured field turned to the level frame, R_x(pitch) R_y(roll) m. The survey's text
/// names the two sides the other way round; the matrix is as printed.
Eigen::Vector3d survey_level_field(const SurveyTilt& tilt, const Eigen::Vector3d& field);

/// (2-12), six cases of 180 deg, 360 deg and 0 minus atan(h_y / h_x), with 90 and 270 deg on the
/// line h_x = 0. Our copy tells of the cases and of the flip between 90 and 270 deg when h_y
/// changes sign near h_x = 0, but does not print them; these are the well-known six (Caruso) that
/// behave so. The result is (2-13) minus 90 deg.
double survey_yaw_six_cases(const Eigen::Vector3d& level_field);

/// (2-13), four cases: yaw counter-clockwise from magnetic north of the y axis, [0, 2 pi). Equals
/// atan2(h_x, h_y) wrapped; zero where both are zero.
double survey_yaw(const Eigen::Vector3d& level_field);

/// Attitude of the body (forward-left-up) in ENU with yaw zero, from one accelerometer reading, by
/// (2-9) and (2-10). Upside-down readings, beyond the survey's +-pi/2, are turned over first.
Eigen::Quaterniond level_attitude(const Eigen::Vector3d& specific_force_mps2);

/// Attitude of the body in magnetic ENU by (2-9) to (2-13).
Eigen::Quaterniond initial_attitude(const Eigen::Vector3d& specific_force_mps2,
                                    const Eigen::Vector3d& field_ut);

/// Turn by an angle counter-clockwise seen from above, rad.
[[nodiscard]] inline Eigen::Quaterniond turn_about_vertical(double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
}

}  // namespace vpdr::pdr
