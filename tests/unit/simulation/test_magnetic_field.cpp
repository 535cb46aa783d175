#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "simulation/magnetic_field.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

FloorPlan corridor() { return FloorPlan({{{-1.2, -1.2}, {60.0, 1.2}}}); }

TEST(MagneticField, UndisturbedFieldPointsNorthAndDown) {
  MagneticFieldOptions options;
  options.disturbance_ut = 0.0;
  options.objects_per_m = 0.0;
  options.dip_rad = to_radians(60.0);
  const MagneticField field(options, corridor(), Random(1, "field"));
  // 48 uT: level 48 cos 60 = 24 north, 48 sin 60 = 41.57 down.
  EXPECT_NEAR((field.at({3.0, 0.5, 1.6}) - Vector3d(0.0, 24.0, -41.569219)).norm(), 0.0, 1e-6);
}

TEST(MagneticField, DeclinationTurnsItEast) {
  MagneticFieldOptions options;
  options.declination_rad = to_radians(10.0);
  const MagneticField field(options, corridor(), Random(1, "field"));
  EXPECT_NEAR(std::atan2(field.undisturbed().x(), field.undisturbed().y()), to_radians(10.0),
              1e-12);
}

TEST(MagneticField, IsCurlAndDivergenceFree) {
  const MagneticField field({}, corridor(), Random(2, "field"));
  const double h = 1e-4;
  for (double x = 0.0; x < 50.0; x += 1.7) {
    const Vector3d here(x, 0.2, 1.5);
    Eigen::Matrix3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = h * Vector3d::Unit(axis);
      gradient.col(axis) = (field.at(here + step) - field.at(here - step)) / (2.0 * h);
    }
    EXPECT_NEAR(gradient.trace(), 0.0, 1e-5);
    EXPECT_NEAR((gradient - gradient.transpose()).norm(), 0.0, 1e-5);
  }
}

TEST(MagneticField, BendsHeadingsBySeveralDegreesAndChangesSmoothly) {
  double squares = 0.0, norms = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const MagneticField field({}, corridor(), Random(seed, "field"));
    for (double x = 0.0; x < 58.0; x += 0.5, ++count) {
      const Vector3d here = field.at({x, 0.0, 1.6});
      squares += std::pow(std::atan2(here.x(), here.y()), 2);
      norms += here.norm();
      EXPECT_LT((field.at({x + 0.05, 0.0, 1.6}) - here).norm(), 1.5);
    }
  }
  EXPECT_NEAR(norms / count, 48.0, 1.5);
  const double rms_deg = to_degrees(std::sqrt(squares / count));
  EXPECT_GT(rms_deg, 2.0);
  EXPECT_LT(rms_deg, 8.0);
}

}  // namespace
}  // namespace vpdr::simulation
