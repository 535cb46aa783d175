#include "calibration_file/calibration_file.hpp"

#include <Eigen/LU>
#include <fstream>

#include "config/binder.hpp"
#include "core/axis_map.hpp"
#include "core/errors.hpp"

namespace vpdr::calibration {
namespace {

using config::any;
using config::at_least;
using config::between;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// A calibration as the file has it: axes by name, matrices row by row.
struct Fields {
  BoardCalibration board;
  struct Sensor {
    std::string axes = "+x,+y,+z";
    RowMajor matrix = RowMajor::Identity();
  };
  Sensor accelerometer;
  Sensor gyroscope;
  Sensor magnetometer;
  RowMajor body_from_board = RowMajor::Identity();
};

void bind_sensor(config::Binder& binder, const std::string& name, const std::string& unit,
                 SensorCalibration& sensor, Fields::Sensor& fields) {
  binder.text(name + ".date", sensor.date, "when it was calibrated, UTC; empty: never");
  binder.text(name + ".axes", fields.axes,
              "sensor axes that point along the board's x, y and z; a mirror is allowed");
  binder.numbers(name + ".bias", sensor.correction.bias.data(), 3, unit,
                 "true = matrix (read - bias), in board axes");
  binder.numbers(name + ".matrix", fields.matrix.data(), 9, "", "row by row");
}

void bind_residuals(config::Binder& binder, const std::string& name, const std::string& unit,
                    const std::string& what, SensorCalibration& sensor) {
  binder.number(name + ".residual_before", sensor.residual_before, at_least(0), unit,
                what + ", before");
  binder.number(name + ".residual", sensor.residual, at_least(0), unit, "and after");
}

void bind(config::Binder& binder, Fields& f) {
  BoardCalibration& b = f.board;
  binder.text("board", b.board, "kind of board");
  binder.text("serial", b.serial, "serial number of this one");

  bind_sensor(binder, "accelerometer", "m/s^2", b.accelerometer, f.accelerometer);
  bind_residuals(binder, "accelerometer", "", "error of gravity's length at rest, share",
                 b.accelerometer);
  binder.integer("accelerometer.poses", b.accelerometer.poses, at_least(0), "",
                 "ways in which the board lay");
  binder.numbers("accelerometer.noise_density", b.accelerometer.noise_density.data(), 3,
                 "m/s^2/sqrt(Hz)", "0: not measured");

  bind_sensor(binder, "gyroscope", "rad/s", b.gyroscope, f.gyroscope);
  bind_residuals(binder, "gyroscope", "rad/s", "bias", b.gyroscope);
  binder.numbers("gyroscope.bias_slope", b.gyroscope.bias_slope.data(), 3, "rad/s/C",
                 "change of the bias for each degree");
  binder.number("gyroscope.temperature_c", b.gyroscope.temperature_c, any(), "C",
                "temperature of the bias");
  binder.number("gyroscope.temperature_span_c", b.gyroscope.temperature_span_c, at_least(0), "C",
                "range of temperature seen; 0: the slope is not used");
  binder.numbers("gyroscope.noise_density", b.gyroscope.noise_density.data(), 3, "rad/s/sqrt(Hz)",
                 "0: not measured");
  binder.numbers("gyroscope.bias_instability", b.gyroscope.bias_instability.data(), 3, "rad/s",
                 "0: not measured");

  bind_sensor(binder, "magnetometer", "uT", b.magnetometer, f.magnetometer);
  bind_residuals(binder, "magnetometer", "", "scatter of the field's length, share",
                 b.magnetometer);
  binder.number("magnetometer.coverage", b.magnetometer.coverage, between(0, 1), "",
                "share of all directions through which the board was turned");
  binder.number("magnetometer.field_ut", b.magnetometer.field_ut, between(0, 200), "uT",
                "strength of the field there");
  binder.number("magnetometer.dip_rad", b.magnetometer.dip_rad, between(-1.571, 1.571), "rad",
                "its angle below the horizon");

  binder.text("mount.date", b.mount.date, "when it was found, UTC; empty: never");
  binder.numbers("mount.body_from_board", f.body_from_board.data(), 9, "",
                 "rotation to forward, left, up; row by row");
  binder.number("mount.walking_s", b.mount.walking_s, at_least(0), "s", "of walking");
  binder.number("mount.straightness", b.mount.straightness, between(0, 1), "",
                "share of the steps' push along forward");
}

/// What is wrong with a file beyond keys and ranges.
class Checks {
 public:
  explicit Checks(std::string file) : file_(std::move(file)) {}

  void sensor(const std::string& name, const Fields::Sensor& fields, SensorCalibration& out) {
    const auto axes = parse_axis_map(fields.axes, true);
    if (axes) {
      out.axes = axes.value();
    } else {
      complain(name + ".axes", axes.error().message);
    }
    out.correction.matrix = fields.matrix;
    const double volume = fields.matrix.determinant();
    if (volume < 0.3 || volume > 3.0) {
      complain(name + ".matrix", "its determinant is " + std::to_string(volume) +
                                     ": a sensor's is about 1; calibrate again");
    }
  }

  void mount(const Fields& fields, BoardCalibration& out) {
    out.mount.body_from_board = fields.body_from_board;
    const Eigen::Matrix3d& m = out.mount.body_from_board;
    const bool is_rotation =
        (m * m.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3 && m.determinant() > 0.0;
    if (!is_rotation)
      complain("mount.body_from_board", "is no rotation; calibrate the mount again");
  }

  void finish() const {
    if (!problems_.empty()) throw ConfigurationFault(problems_);
  }

 private:
  void complain(const std::string& key, const std::string& what) {
    if (!problems_.empty()) problems_ += '\n';
    problems_ += file_ + ": calibration." + key + ": " + what;
  }

  std::string file_;
  std::string problems_;
};

Fields fields_of(const BoardCalibration& board) {
  Fields f;
  f.board = board;
  f.accelerometer = {axis_map_name(board.accelerometer.axes),
                     board.accelerometer.correction.matrix};
  f.gyroscope = {axis_map_name(board.gyroscope.axes), board.gyroscope.correction.matrix};
  f.magnetometer = {axis_map_name(board.magnetometer.axes), board.magnetometer.correction.matrix};
  f.body_from_board = board.mount.body_from_board;
  return f;
}

}  // namespace

BoardCalibration read_calibration(const std::filesystem::path& file) {
  Fields fields;
  config::Binder binder("calibration");
  bind(binder, fields);
  binder.load_file(file);
  Checks checks(file.string());
  checks.sensor("accelerometer", fields.accelerometer, fields.board.accelerometer);
  checks.sensor("gyroscope", fields.gyroscope, fields.board.gyroscope);
  checks.sensor("magnetometer", fields.magnetometer, fields.board.magnetometer);
  checks.mount(fields, fields.board);
  checks.finish();
  return fields.board;
}

void write_calibration(const BoardCalibration& board, const std::filesystem::path& file) {
  Fields fields = fields_of(board);
  config::Binder binder("calibration");
  bind(binder, fields);
  std::filesystem::path temporary = file;
  temporary += ".new";
  std::ofstream out(temporary);
  out << binder.print_yaml();
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, file, error);
  if (!out || error) {
    throw FileFault(file.string() +
                    ": cannot be written; does the folder exist, is the disk full?");
  }
}

}  // namespace vpdr::calibration
