#include "simulation/sensor_errors.hpp"

#include <cmath>

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kScaleHeightM = 8434.0;  // of the atmosphere at 15 degrees Celsius

double quantised(double value, double quantum) {
  return quantum > 0.0 ? std::round(value / quantum) * quantum : value;
}

}  // namespace

SensorErrors SensorErrors::none() {
  SensorErrors errors;
  errors.accelerometer = errors.gyroscope = errors.magnetometer = TriadErrors{};
  errors.pressure_noise_pa = errors.pressure_offset_pa = 0.0;
  errors.pressure_walk_pa = errors.pressure_quantum_pa = 0.0;
  return errors;
}

TriadSensor::TriadSensor(const TriadErrors& errors, double rate_hz, Random random)
    : errors_(errors), noise_(errors.noise_density * std::sqrt(rate_hz)), random_(random) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      response_(row, column) +=
          random_.normal(row == column ? errors.scale_error : errors.misalignment_rad);
    }
  }
  bias_ = normal(errors.turn_on_bias);
}

Vector3d TriadSensor::normal(double standard_deviation) {
  // One after the other: the order of evaluation of constructor arguments is not fixed.
  Vector3d v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = random_.normal(standard_deviation);
  return v;
}

Vector3d TriadSensor::read(const Vector3d& truth, double interval_s) {
  bias_ += normal(errors_.bias_walk * std::sqrt(interval_s));
  const Vector3d reading = response_ * truth + bias_ + normal(noise_);
  const double quantum = errors_.quantum;
  return reading.unaryExpr([quantum](double value) { return quantised(value, quantum); });
}

Barometer::Barometer(const SensorErrors& errors, Random random)
    : errors_(errors), random_(random), offset_pa_(random_.normal(errors.pressure_offset_pa)) {}

double Barometer::read(double height_m, double interval_s) {
  offset_pa_ += random_.normal(errors_.pressure_walk_pa * std::sqrt(interval_s));
  const double truth = errors_.sea_level_pressure_pa * std::exp(-height_m / kScaleHeightM);
  return quantised(truth + offset_pa_ + random_.normal(errors_.pressure_noise_pa),
                   errors_.pressure_quantum_pa);
}

}  // namespace vpdr::simulation
