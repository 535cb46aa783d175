#include "calibration/calibrate.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "calibration/allan_deviation.hpp"
#include "calibration/turns.hpp"
#include "core/axis_map.hpp"

namespace vpdr::calibration {
namespace {

/// How far turns may be from a clean map of the axes and still tell which axis is which.
constexpr double kMaxAxisError = 0.35;
/// How well turns must tell a matrix before its small angles are believed: half a degree.
constexpr double kMaxMatrixSigma = 0.01;

void turn(std::vector<TimedVector>& stream, const Eigen::Matrix3d& axes) {
  for (TimedVector& sample : stream) sample.value = axes * sample.value;
}

void correct(std::vector<TimedVector>& stream, const SensorCalibration& sensor) {
  for (TimedVector& sample : stream) sample.value = sensor.apply(sample.value);
}

/// The map of the axes that turns tell; nullopt where they tell none.
std::optional<Eigen::Matrix3d> axes_by_turns(
    const std::optional<RateAlignment::Solution>& alignment) {
  if (!alignment || alignment->worst_sigma > kMaxAxisError) return std::nullopt;
  const Eigen::Matrix3d map = nearest_axis_map(alignment->direction_from_gyro);
  const double error = (alignment->direction_from_gyro - map).cwiseAbs().maxCoeff();
  if (error > kMaxAxisError) return std::nullopt;
  return map;
}

/// Rotation nearest to a matrix.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// All axes of an accelerometer that reads gravity's own direction instead of the force against it.
Status settle_sign(const std::vector<Rest>& rests, const CalibrationOptions& options,
                   AccelerometerSection& accelerometer) {
  accelerometer.axes.setIdentity();
  if (!options.first_up) return Done{};
  if (rests.empty()) return Error{"the board never lay still"};
  const Eigen::Vector3d first = rests.front().force_mps2.normalized();
  const double upward = first.dot(*options.first_up);
  if (std::abs(upward) < 0.8) {
    return Error{
        "in its first rest the board read gravity along other axes than the one that was "
        "said to point up; check --up"};
  }
  if (upward < 0.0) accelerometer.axes = -Eigen::Matrix3d::Identity();
  return Done{};
}

void measure_noise(const SensorStreams& streams, const std::vector<Rest>& rests, Calibrated& out) {
  const auto longest = std::max_element(
      rests.begin(), rests.end(),
      [](const Rest& a, const Rest& b) { return a.duration_s() < b.duration_s(); });
  if (longest == rests.end()) return;
  const auto rate = allan_deviation(streams.rate_radps, longest->begin_ns, longest->end_ns);
  const auto force = allan_deviation(streams.force_mps2, longest->begin_ns, longest->end_ns);
  if (rate) {
    out.board.gyroscope.noise_density = rate.value().noise_density;
    out.board.gyroscope.bias_instability = rate.value().bias_instability;
  }
  if (force) out.board.accelerometer.noise_density = force.value().noise_density;
  if (!rate && !streams.rate_radps.empty()) {
    out.notes.push_back("noise not measured: " + rate.error().message);
  }
}

/// The gyroscope's axes by the turns between the rests, seen by the accelerometer (board axes).
void find_gyroscope_axes(const SensorStreams& streams, const Eigen::Vector3d& bias,
                         Calibrated& out) {
  TurnConfig config;
  config.sigma = 0.05;  // a hand's acceleration tilts gravity by some degrees
  const auto axes =
      axes_by_turns(align_rates(streams.rate_radps, bias, streams.force_mps2, config));
  GyroscopeSection& gyroscope = out.board.gyroscope;
  if (!axes) {
    gyroscope.axes.setIdentity();
    out.notes.emplace_back(
        "the gyroscope's axes are taken to be the accelerometer's: to check them, turn the board "
        "slowly about each of its axes between the rests");
    return;
  }
  gyroscope.axes = *axes;
  if (axes->isIdentity()) return;
  out.notes.push_back("the gyroscope's axes are " + axis_map_name(*axes) + " in board axes" +
                      (axes->determinant() < 0.0 ? ": as sent they are left-handed" : ""));
}

/// The magnetometer's correction, so far in the sensor's own axes, to those of the board: which
/// axis is which and the small angles between, by the turns that the gyroscope saw too.
Status turn_to_board(const SensorStreams& streams, Calibrated& out) {
  MagnetometerSection& magnetometer = out.board.magnetometer;
  const SensorStreams board = corrected(streams, out.board);
  // G from the gyroscope's (board) axes to the magnetometer's, and so back from these.
  const auto alignment = align_rates(board.rate_radps, Eigen::Vector3d::Zero(), board.field_ut);
  const auto axes = axes_by_turns(alignment);
  if (!axes) {
    out.notes.emplace_back(
        "the magnetometer's axes are taken to be the board's: without a calibrated gyroscope, or "
        "with turns too few, they cannot be checked");
    return Done{};
  }
  if (axes->determinant() < 0.0) {
    return Error{
        "gyroscope and magnetometer disagree on which way the board turns: one of them is "
        "left-handed; run vpdr calibrate imu first, with turns between the rests"};
  }
  const Eigen::Matrix3d map = axes->transpose();
  Eigen::Matrix3d aligned = Eigen::Matrix3d::Identity();
  if (alignment->worst_sigma < kMaxMatrixSigma) {
    aligned = nearest_rotation(alignment->direction_from_gyro * map).transpose();
  }
  const LinearCorrection sensor = magnetometer.correction;
  magnetometer.axes = map;
  magnetometer.correction = {map * aligned * sensor.matrix * map.transpose(), map * sensor.bias};
  return Done{};
}

/// Dip of the field, and the magnetometer's signs: turns cannot tell a field from its opposite, the
/// hemisphere can.
void settle_hemisphere(const SensorStreams& streams, bool southern, Calibrated& out) {
  MagnetometerSection& magnetometer = out.board.magnetometer;
  const SensorStreams board = corrected(streams, out.board);
  const auto dip = measure_dip(board.field_ut, board.force_mps2);
  if (!dip) return;
  magnetometer.dip_rad = dip->angle_rad;
  if ((dip->angle_rad < 0.0) == southern) return;
  magnetometer.axes = -magnetometer.axes;
  magnetometer.correction.bias = -magnetometer.correction.bias;
  magnetometer.dip_rad = -dip->angle_rad;
  out.notes.push_back("the magnetometer's signs are turned round (" +
                      axis_map_name(magnetometer.axes) + "), or else the field would point " +
                      (southern ? "down" : "up") + "; is this the " +
                      (southern ? "southern" : "northern") + " hemisphere?");
}

}  // namespace

SensorStreams corrected(const SensorStreams& streams, const BoardCalibration& board) {
  SensorStreams out = streams;
  correct(out.force_mps2, board.accelerometer);
  correct(out.rate_radps, board.gyroscope);
  correct(out.field_ut, board.magnetometer);
  return out;
}

Result<Calibrated> calibrate_imu(const SensorStreams& streams, const BoardCalibration& known,
                                 const CalibrationOptions& options) {
  if (streams.force_mps2.empty()) return Error{"there are no accelerometer readings"};
  Calibrated out{known, {}};
  AccelerometerSection& accelerometer = out.board.accelerometer;
  const Status sign = settle_sign(find_rests(streams), options, accelerometer);
  if (!sign) return sign.error();
  SensorStreams board = streams;
  turn(board.force_mps2, accelerometer.axes);
  const std::vector<Rest> rests = find_rests(board);
  const auto force = calibrate_accelerometer(board, rests);
  if (!force) return force.error();
  accelerometer.date = options.date;
  accelerometer.correction = force.value().correction;
  accelerometer.poses = static_cast<unsigned>(force.value().poses);
  accelerometer.residual_before = force.value().rms_before;
  accelerometer.residual = force.value().rms;
  if (!streams.rate_radps.empty()) {
    const auto bias = calibrate_gyroscope(board, rests);
    if (!bias) return bias.error();
    find_gyroscope_axes(board, bias.value().bias_radps, out);
    GyroscopeSection& gyroscope = out.board.gyroscope;
    gyroscope.date = options.date;
    gyroscope.correction = {Eigen::Matrix3d::Identity(), gyroscope.axes * bias.value().bias_radps};
    gyroscope.bias_slope = gyroscope.axes * bias.value().slope_radps_per_c;
    gyroscope.temperature_c = bias.value().temperature_c;
    gyroscope.temperature_span_c = bias.value().temperature_span_c;
    gyroscope.residual_before = bias.value().bias_radps.norm();
    gyroscope.residual = bias.value().residual_radps.norm();
  }
  measure_noise(board, rests, out);
  return out;
}

Result<Calibrated> calibrate_mag(const SensorStreams& streams, const BoardCalibration& known,
                                 const CalibrationOptions& options) {
  if (streams.field_ut.empty()) return Error{"there are no magnetometer readings"};
  const auto fit = calibrate_magnetometer(streams.field_ut);
  if (!fit) return fit.error();
  Calibrated out{known, {}};
  MagnetometerSection& magnetometer = out.board.magnetometer;
  magnetometer.axes.setIdentity();
  magnetometer.correction = fit.value().correction;
  magnetometer.date = options.date;
  magnetometer.coverage = fit.value().coverage;
  magnetometer.field_ut = fit.value().field_ut;
  magnetometer.residual_before = fit.value().rms_before;
  magnetometer.residual = fit.value().rms;
  const Status axes = turn_to_board(streams, out);
  if (!axes) return axes.error();
  settle_hemisphere(streams, options.southern, out);
  return out;
}

Result<Calibrated> calibrate_mount(const SensorStreams& streams, const BoardCalibration& known,
                                   const CalibrationOptions& options) {
  if (streams.force_mps2.empty()) return Error{"there are no accelerometer readings"};
  const auto mount = estimate_mount(corrected(streams, known));
  if (!mount) return mount.error();
  Calibrated out{known, {}};
  out.board.mount.date = options.date;
  out.board.mount.body_from_board = mount.value().body_from_board;
  out.board.mount.walking_s = mount.value().walking_s;
  out.board.mount.straightness = mount.value().straightness;
  return out;
}

}  // namespace vpdr::calibration
