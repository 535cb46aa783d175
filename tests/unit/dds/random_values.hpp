#pragma once
#include <random>

#include "core/estimates.hpp"
#include "core/time.hpp"

namespace vpdr::dds::test {

/// Random values of the core's types, every field different.
class Random {
 public:
  double number() { return std::uniform_real_distribution(-100.0, 100.0)(engine_); }
  TimestampNs stamp() {
    return std::uniform_int_distribution<TimestampNs>(-1'000 * kNsPerSecond,
                                                      2'000'000'000 * kNsPerSecond)(engine_);
  }
  std::uint32_t index() { return std::uniform_int_distribution<std::uint32_t>()(engine_); }
  bool flag() { return index() % 2 == 1; }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  Eigen::Quaterniond rotation() {
    return Eigen::Quaterniond(number(), number(), number(), number()).normalized();
  }
  template <class Matrix>
  Matrix matrix() {
    return Matrix::NullaryExpr([this] { return number(); });
  }
  PoseEstimate pose() {
    return {stamp(), vector(), rotation(), matrix<Matrix6d>(), vector(), number()};
  }

 private:
  std::mt19937_64 engine_{7};
};

}  // namespace vpdr::dds::test
