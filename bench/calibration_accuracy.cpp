// Calibration of the real boards and phones of the recordings: before and after. Run by hand:
//   build/bin/bench_calibration_accuracy DATA
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/allan_deviation.hpp"
#include "calibration/calibrate.hpp"
#include "calibration/turns.hpp"
#include "core/axis_map.hpp"
#include "core/rotation.hpp"
#include "dataset/board_log.hpp"

namespace vpdr::bench {
namespace {

namespace fs = std::filesystem;
using namespace calibration;

/// RMS of the length's error over every single reading, percent of `length`.
double scatter(const std::vector<TimedVector>& stream, double length) {
  double squares = 0.0;
  for (const TimedVector& v : stream) squares += std::pow(v.value.norm() / length - 1.0, 2);
  return 100.0 * std::sqrt(squares / static_cast<double>(stream.size()));
}

double mean_length(const std::vector<TimedVector>& stream) {
  double sum = 0.0;
  for (const TimedVector& v : stream) sum += v.value.norm();
  return sum / static_cast<double>(stream.size());
}

void print_notes(const Calibrated& calibrated) {
  for (const std::string& note : calibrated.notes) std::printf("    note: %s\n", note.c_str());
}

void print_imu(const BoardCalibration& board) {
  const AccelerometerSection& a = board.accelerometer;
  std::printf("  accelerometer  %u poses, length at rest %.2f %% -> %.3f %%, axes %s\n", a.poses,
              100.0 * a.residual_before, 100.0 * a.residual, axis_map_name(a.axes).c_str());
  if (board.gyroscope.date.empty()) return;
  const Eigen::Vector3d bias = board.gyroscope.correction.bias * (180.0 / kPi);
  std::printf("  gyroscope      bias %.3f %.3f %.3f deg/s, axes %s\n", bias.x(), bias.y(), bias.z(),
              axis_map_name(board.gyroscope.axes).c_str());
}

void print_mag(const SensorStreams& streams, const BoardCalibration& board) {
  const MagnetometerSection& m = board.magnetometer;
  const SensorStreams after = corrected(streams, board);
  std::printf(
      "  magnetometer   coverage %.0f %%, length %.1f %% -> %.2f %% of means, %.1f %% -> "
      "%.2f %% of single readings, axes %s\n",
      100.0 * m.coverage, 100.0 * m.residual_before, 100.0 * m.residual,
      scatter(streams.field_ut, mean_length(streams.field_ut)), scatter(after.field_ut, m.field_ut),
      axis_map_name(m.axes).c_str());
  std::printf("                 field %.1f uT, dip %.1f deg\n", m.field_ut, to_degrees(m.dip_rad));
}

SensorStreams board_streams(const fs::path& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    files.push_back(folder / (name + "_mpu6050.csv"));
    files.push_back(folder / (name + "_hmc5883l.csv"));
  }
  return dataset::read_board_logs(files).streams;
}

void print_drift(const fs::path& folder) {
  const SensorStreams streams = board_streams(folder, {"unmoved-with-x-pointing-forward-10min"});
  const std::vector<Rest> rests = find_rests(streams);
  const auto bias = calibrate_gyroscope(streams, rests);
  if (!bias) throw std::runtime_error(bias.error().message);
  const GyroscopeBias& b = bias.value();
  constexpr double kMdps = 180e3 / kPi;
  std::printf("  ten minutes at rest, temperature range %.2f C; means over 5 s, mdeg/s:\n",
              b.temperature_span_c);
  for (int axis = 0; axis < 3; ++axis) {
    std::printf(
        "    %c  wander %.1f = temperature %.1f (%.0f mdeg/s/C), white noise %.1f, rest %.1f\n",
        "xyz"[axis], kMdps * b.wander_radps[axis],
        kMdps * std::sqrt(std::max(
                    0.0, std::pow(b.wander_radps[axis], 2) - std::pow(b.residual_radps[axis], 2))),
        kMdps * b.slope_radps_per_c[axis], kMdps * b.noise_radps[axis],
        kMdps * std::sqrt(std::max(
                    0.0, std::pow(b.residual_radps[axis], 2) - std::pow(b.noise_radps[axis], 2))));
  }
  const auto allan =
      allan_deviation(streams.rate_radps, rests.front().begin_ns, rests.back().end_ns);
  if (!allan) throw std::runtime_error(allan.error().message);
  const Eigen::Vector3d density = kMdps * allan.value().noise_density;
  const Eigen::Vector3d flicker = kMdps * allan.value().bias_instability;
  std::printf(
      "    Allan: noise %.1f %.1f %.1f mdeg/s/sqrt(Hz), bias instability %.1f %.1f %.1f mdeg/s\n",
      density.x(), density.y(), density.z(), flicker.x(), flicker.y(), flicker.z());
}

void print_turns(const fs::path& folder, const BoardCalibration& board) {
  for (const char* name :
       {"rotate-ccw-around-x-pointing-forward", "rotate-ccw-around-x-pointing-up",
        "rotate-ccw-around-y-pointing-left", "rotate-ccw-around-z-pointing-up"}) {
    const SensorStreams before = board_streams(folder, {name});
    const SensorStreams after = corrected(before, board);
    const auto turns = [](const std::vector<TimedVector>& rates) {
      return integrated_turn(rates, rates.front().stamp_ns, rates.back().stamp_ns + 1).norm() /
             (2.0 * kPi);
    };
    std::printf("  %-38s %.3f -> %.3f turns (%+.2f %% of two)\n", name, turns(before.rate_radps),
                turns(after.rate_radps), 50.0 * (turns(after.rate_radps) - 2.0));
  }
}

Calibrated expect(const Result<Calibrated>& result) {
  if (!result) throw std::runtime_error(result.error().message);
  print_notes(result.value());
  return result.value();
}

void run_board(const fs::path& folder) {
  std::printf("MPU6050 + HMC5883L\n");
  CalibrationOptions options{.date = "now", .first_up = Eigen::Vector3d::UnitZ()};
  const SensorStreams rests = board_streams(
      folder, {"unmoved-with-x-pointing-forward", "unmoved-with-z-pointing-front-and-x-up",
               "unmoved-with-z-pointing-front-and-y-down", "full-sphere"});
  BoardCalibration board = expect(calibrate_imu(rests, {}, options)).board;
  print_imu(board);
  const SensorStreams sphere = board_streams(folder, {"full-sphere"});
  board = expect(calibrate_mag(sphere, board, options)).board;
  print_mag(sphere, board);
  print_turns(folder, board);
  print_drift(folder);
}

void run_phone(const fs::path& folder, const std::string& suffix) {
  std::printf("Nexus 5, %s\n", suffix.c_str());
  CalibrationOptions options{.date = "now", .first_up = {}};
  const SensorStreams rests =
      dataset::read_board_log(folder / ("calib_acc_" + suffix) / "accelerometer.txt").streams;
  BoardCalibration board = expect(calibrate_imu(rests, {}, options)).board;
  print_imu(board);
  const SensorStreams still =
      dataset::read_board_log(folder / ("calib_gyr_" + suffix) / "gyroscope.txt").streams;
  const auto bias = calibrate_gyroscope(still, find_rests(still));
  if (!bias) throw std::runtime_error(bias.error().message);
  const Eigen::Vector3d b = bias.value().bias_radps * (180.0 / kPi);
  std::printf("  gyroscope      bias %.3f %.3f %.3f deg/s over %.0f s\n", b.x(), b.y(), b.z(),
              bias.value().rest_s);
  const fs::path turned = folder / ("calib_mag_" + suffix);
  const SensorStreams sphere =
      dataset::read_board_logs({turned / "accelerometer.txt", turned / "magnetometer.txt"}).streams;
  print_mag(sphere, expect(calibrate_mag(sphere, board, options)).board);
}

}  // namespace
}  // namespace vpdr::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_calibration_accuracy DATA\n");
    return 2;
  }
  try {
    const std::filesystem::path boards = std::filesystem::path(argv[1]) / "boards";
    vpdr::bench::run_board(boards / "mpu6050_hmc5883l_sunsided");
    for (const char* day : {"Nexus5_d1", "Nexus5_d2", "Nexus5_d3"}) {
      vpdr::bench::run_phone(boards / "phone_calibration", day);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_calibration_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
