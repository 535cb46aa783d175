// What one update of pdr's attitude filter costs, all nine axes, against a textbook Madgwick step
// in the same run, at the rate of BROAD's board (286 Hz) and at 100 Hz:
//   bench_ahrs_speed [Google Benchmark's options]
// Both get the same readings of a swinging, turning board. The ratio is printed at the end; only it
// is comparable between machines.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"

namespace {

using namespace vpdr;  // NOLINT: a program, not a header
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Reading {
  ImuSample imu;
  MagSample mag;
};

std::vector<Reading> make_readings(double rate_hz, double duration_s) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto noise = [&](double sigma) {
    return Vector3d(sigma * normal(random), sigma * normal(random), sigma * normal(random));
  };
  const auto attitude = [](double t) {
    return from_euler({0.6 * std::sin(2.1 * t), 0.5 * std::sin(1.3 * t), 0.8 * t});
  };
  std::vector<Reading> readings;
  for (int i = 0; i < static_cast<int>(duration_s * rate_hz); ++i) {
    const double t = i / rate_hz;
    const Quaterniond q = attitude(t);
    Reading reading;
    reading.imu.stamp_ns = to_ns(t);
    reading.mag.stamp_ns = to_ns(t);
    reading.imu.angular_velocity_radps =
        log_rotation(attitude(t - 1e-4).conjugate() * attitude(t + 1e-4)) / 2e-4 + noise(0.005);
    reading.imu.specific_force_mps2 =
        q.conjugate() * Vector3d(std::sin(11.0 * t), 0.0, kGravityMps2) + noise(0.1);
    reading.mag.field_ut = q.conjugate() * Vector3d(0.0, 20.0, -40.0) + noise(0.5);
    readings.push_back(reading);
  }
  return readings;
}

/// The textbook: S. Madgwick 2010, gradient descent with gyroscope, accelerometer and magnetometer.
class Madgwick {
 public:
  explicit Madgwick(double rate_hz) : dt_(1.0 / rate_hz) {}

  void update(const Vector3d& gyro, Vector3d a, Vector3d m) {
    double qw = q_.w(), qx = q_.x(), qy = q_.y(), qz = q_.z();
    double dw = 0.5 * (-qx * gyro.x() - qy * gyro.y() - qz * gyro.z());
    double dx = 0.5 * (qw * gyro.x() + qy * gyro.z() - qz * gyro.y());
    double dy = 0.5 * (qw * gyro.y() - qx * gyro.z() + qz * gyro.x());
    double dz = 0.5 * (qw * gyro.z() + qx * gyro.y() - qy * gyro.x());
    a.normalize();
    m.normalize();
    // The field in the estimate's world, turned to have no east component.
    const double hx = 2.0 * (m.x() * (0.5 - qy * qy - qz * qz) + m.y() * (qx * qy - qw * qz) +
                             m.z() * (qx * qz + qw * qy));
    const double hy = 2.0 * (m.x() * (qx * qy + qw * qz) + m.y() * (0.5 - qx * qx - qz * qz) +
                             m.z() * (qy * qz - qw * qx));
    const double bx = std::sqrt(hx * hx + hy * hy);
    const double bz = 2.0 * (m.x() * (qx * qz - qw * qy) + m.y() * (qy * qz + qw * qx) +
                             m.z() * (0.5 - qx * qx - qy * qy));
    const double f1 = 2.0 * (qx * qz - qw * qy) - a.x();
    const double f2 = 2.0 * (qw * qx + qy * qz) - a.y();
    const double f3 = 2.0 * (0.5 - qx * qx - qy * qy) - a.z();
    const double f4 = 2.0 * bx * (0.5 - qy * qy - qz * qz) + 2.0 * bz * (qx * qz - qw * qy) - m.x();
    const double f5 = 2.0 * bx * (qx * qy - qw * qz) + 2.0 * bz * (qw * qx + qy * qz) - m.y();
    const double f6 = 2.0 * bx * (qw * qy + qx * qz) + 2.0 * bz * (0.5 - qx * qx - qy * qy) - m.z();
    double sw = -2.0 * qy * f1 + 2.0 * qx * f2 - 2.0 * bz * qy * f4 +
                (-2.0 * bx * qz + 2.0 * bz * qx) * f5 + 2.0 * bx * qy * f6;
    double sx = 2.0 * qz * f1 + 2.0 * qw * f2 - 4.0 * qx * f3 + 2.0 * bz * qz * f4 +
                (2.0 * bx * qy + 2.0 * bz * qw) * f5 + (2.0 * bx * qz - 4.0 * bz * qx) * f6;
    double sy = -2.0 * qw * f1 + 2.0 * qz * f2 - 4.0 * qy * f3 +
                (-4.0 * bx * qy - 2.0 * bz * qw) * f4 + (2.0 * bx * qx + 2.0 * bz * qz) * f5 +
                (2.0 * bx * qw - 4.0 * bz * qy) * f6;
    double sz = 2.0 * qx * f1 + 2.0 * qy * f2 + (-4.0 * bx * qz + 2.0 * bz * qx) * f4 +
                (-2.0 * bx * qw + 2.0 * bz * qy) * f5 + 2.0 * bx * qx * f6;
    const double step = kBeta / std::sqrt(sw * sw + sx * sx + sy * sy + sz * sz);
    qw += (dw - step * sw) * dt_;
    qx += (dx - step * sx) * dt_;
    qy += (dy - step * sy) * dt_;
    qz += (dz - step * sz) * dt_;
    const double scale = 1.0 / std::sqrt(qw * qw + qx * qx + qy * qy + qz * qz);
    q_ = Quaterniond(qw * scale, qx * scale, qy * scale, qz * scale);
  }

  [[nodiscard]] const Quaterniond& world_from_body() const { return q_; }

 private:
  static constexpr double kBeta = 0.1;
  double dt_;
  Quaterniond q_ = Quaterniond::Identity();
};

void madgwick(benchmark::State& state) {
  const auto rate_hz = static_cast<double>(state.range(0));
  const std::vector<Reading> readings = make_readings(rate_hz, 20.0);
  for (auto _ : state) {
    Madgwick filter(rate_hz);
    for (const Reading& reading : readings) {
      filter.update(reading.imu.angular_velocity_radps, reading.imu.specific_force_mps2,
                    reading.mag.field_ut);
      benchmark::DoNotOptimize(filter.world_from_body());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(readings.size()));
}

void vpdr_filter(benchmark::State& state) {
  const std::vector<Reading> readings = make_readings(static_cast<double>(state.range(0)), 20.0);
  for (auto _ : state) {
    pdr::AttitudeFilter filter;
    for (const Reading& reading : readings) {
      filter.process(reading.mag);
      filter.process(reading.imu);
      benchmark::DoNotOptimize(filter.world_from_body());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(readings.size()));
}

BENCHMARK(madgwick)->Arg(286)->Arg(100);
BENCHMARK(vpdr_filter)->Arg(286)->Arg(100);

/// Prints as usual and keeps what one update took, ns, by the benchmark's name.
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const auto rate = run.counters.find("items_per_second");
      if (rate == run.counters.end() || run.run_type != Run::RT_Iteration) continue;
      double& best = update_ns_[run.benchmark_name()];
      const double taken = 1e9 / rate->second;
      best = best > 0.0 ? std::min(best, taken) : taken;
    }
  }

  void print() const {
    for (const char* rate : {"286", "100"}) {
      const auto ours = update_ns_.find(std::string("vpdr_filter/") + rate);
      const auto theirs = update_ns_.find(std::string("madgwick/") + rate);
      if (ours == update_ns_.end() || theirs == update_ns_.end()) continue;
      std::printf("%s Hz: vpdr %.0f ns, textbook Madgwick %.0f ns an update, ratio %.2f\n", rate,
                  ours->second, theirs->second, ours->second / theirs->second);
    }
  }

 private:
  std::map<std::string, double> update_ns_;  ///< the fastest repetition
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  ratios.print();
  return 0;
}
