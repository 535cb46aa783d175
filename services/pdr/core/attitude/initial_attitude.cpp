#include "pdr/core/attitude/initial_attitude.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

double safe_asin(double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); }

/// Survey axes (right, forward, up) of a vector in body axes (forward, left, up).
Vector3d survey_from_body(const Vector3d& v) { return {-v.y(), v.x(), v.z()}; }

/// World (ENU) from survey axes, rotated by Z, X, Y.
Quaterniond world_from_survey(double yaw_rad, const SurveyTilt& tilt) {
  return AngleAxisd(yaw_rad, Vector3d::UnitZ()) * AngleAxisd(tilt.pitch_rad, Vector3d::UnitX()) *
         AngleAxisd(tilt.roll_rad, Vector3d::UnitY());
}

/// Survey axes from body axes, as a rotation: a quarter turn about z.
Quaterniond survey_from_body_rotation() {
  return Quaterniond(AngleAxisd(0.5 * kPi, Vector3d::UnitZ()));
}

/// Half a turn about the forward axis: brings an upside-down board into the survey's range.
Vector3d turned_over(const Vector3d& survey) { return {-survey.x(), survey.y(), -survey.z()}; }

Quaterniond attitude(const Vector3d& specific_force_mps2, const Vector3d* field_ut) {
  const Vector3d reading = survey_from_body(specific_force_mps2);
  const bool upside_down = reading.z() < 0.0;
  const Vector3d gravity = -(upside_down ? turned_over(reading) : reading);
  const SurveyTilt tilt = survey_tilt(gravity);
  double yaw = -0.5 * kPi;  // faces east: body yaw zero
  if (field_ut != nullptr) {
    const Vector3d field = survey_from_body(*field_ut);
    yaw = survey_yaw(survey_level_field(tilt, upside_down ? turned_over(field) : field));
  }
  Quaterniond world = world_from_survey(yaw, tilt);
  if (upside_down) world = world * Quaterniond(AngleAxisd(kPi, Vector3d::UnitY()));
  return (world * survey_from_body_rotation()).normalized();
}

}  // namespace

Vector3d survey_gravity(const SurveyTilt& tilt, double gravity_mps2) {
  const double cos_pitch = std::cos(tilt.pitch_rad);
  return gravity_mps2 * Vector3d(std::sin(tilt.roll_rad) * cos_pitch, -std::sin(tilt.pitch_rad),
                                 -std::cos(tilt.roll_rad) * cos_pitch);
}

SurveyTilt survey_tilt(const Vector3d& gravity_mps2) {
  const double norm = gravity_mps2.norm();
  if (norm <= 0.0) return {};
  SurveyTilt tilt;
  tilt.pitch_rad = safe_asin(-gravity_mps2.y() / norm);
  if (std::abs(gravity_mps2.z()) >= 0.1 * norm) {
    tilt.roll_rad = -std::atan(gravity_mps2.x() / gravity_mps2.z());
  } else {
    const double level = norm * std::cos(tilt.pitch_rad);
    tilt.roll_rad = level > 0.0 ? safe_asin(gravity_mps2.x() / level) : 0.0;
  }
  return tilt;
}

Vector3d survey_level_field(const SurveyTilt& tilt, const Vector3d& field) {
  const double cr = std::cos(tilt.roll_rad);
  const double sr = std::sin(tilt.roll_rad);
  const double cp = std::cos(tilt.pitch_rad);
  const double sp = std::sin(tilt.pitch_rad);
  Eigen::Matrix3d level_from_body;
  level_from_body << cr, 0.0, sr, sr * sp, cp, -cr * sp, -sr * cp, sp, cr * cp;
  return level_from_body * field;
}

double survey_yaw_six_cases(const Vector3d& h) {
  if (h.x() == 0.0 && h.y() <= 0.0) return 0.5 * kPi;
  if (h.x() == 0.0) return 1.5 * kPi;
  const double quotient = std::atan(h.y() / h.x());
  if (h.x() < 0.0) return kPi - quotient;
  if (h.y() < 0.0) return -quotient;
  return h.y() > 0.0 ? 2.0 * kPi - quotient : 0.0;
}

double survey_yaw(const Vector3d& h) {
  if (h.x() >= 0.0 && h.y() > 0.0) return std::atan(h.x() / h.y());
  if (h.x() > 0.0 && h.y() <= 0.0) return 0.5 * kPi + std::atan(std::abs(h.y()) / h.x());
  if (h.x() <= 0.0 && h.y() < 0.0) return kPi + std::atan(h.x() / h.y());
  if (h.x() < 0.0 && h.y() >= 0.0) return 1.5 * kPi + std::atan(h.y() / std::abs(h.x()));
  return 0.0;
}

Quaterniond level_attitude(const Vector3d& specific_force_mps2) {
  return attitude(specific_force_mps2, nullptr);
}

Quaterniond initial_attitude(const Vector3d& specific_force_mps2, const Vector3d& field_ut) {
  return attitude(specific_force_mps2, &field_ut);
}

}  // namespace vpdr::pdr
