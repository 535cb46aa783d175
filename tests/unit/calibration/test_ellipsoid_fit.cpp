#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "calibration/ellipsoid_fit.hpp"

namespace vpdr::calibration {
namespace {

/// Directions spread evenly over the sphere.
std::vector<Eigen::Vector3d> directions(int count) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    out.emplace_back(r * std::cos(2.39996 * i), r * std::sin(2.39996 * i), z);
  }
  return out;
}

Eigen::Matrix3d symmetric(double xx, double yy, double zz, double xy, double xz, double yz) {
  Eigen::Matrix3d m;
  m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return m;
}

TEST(FitSphere, ByHand) {
  // Six points at distance 2 from (1, 2, 3).
  std::vector<LengthSample> samples;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-2.0, 2.0}) {
      Eigen::Vector3d v(1, 2, 3);
      v[axis] += side;
      samples.push_back({v, 1.0});
    }
  }
  const Sphere sphere = fit_sphere(samples);
  EXPECT_NEAR((sphere.centre - Eigen::Vector3d(1, 2, 3)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(sphere.radius, 2.0, 1e-9);
}

TEST(FitSphere, FarPointsDoNotPull) {
  std::vector<LengthSample> samples;
  for (const auto& d : directions(100)) samples.push_back({d * 50.0, 1.0});
  for (int i = 0; i < 10; ++i) samples.push_back({Eigen::Vector3d(300.0 + i, 100.0, 0.0), 1.0});
  const Sphere sphere = fit_sphere(samples);
  EXPECT_LT(sphere.centre.norm(), 0.5);
  EXPECT_NEAR(sphere.radius, 50.0, 0.5);
}

TEST(FitEllipsoid, SixReadingsByHand) {
  // x reads 10 % too much and is 0.5 off, y is 0.2 off, z reads 5 % too little: of a length of 10.
  const std::vector<LengthSample> samples{{{11.5, 0.2, 0.0}, 1e-3}, {{-10.5, 0.2, 0.0}, 1e-3},
                                          {{0.5, 10.2, 0.0}, 1e-3}, {{0.5, -9.8, 0.0}, 1e-3},
                                          {{0.5, 0.2, 9.5}, 1e-3},  {{0.5, 0.2, -9.5}, 1e-3}};
  const EllipsoidFit fit = fit_ellipsoid(samples, {Eigen::Vector3d::Zero(), 10.0}, {});
  EXPECT_NEAR((fit.correction.bias - Eigen::Vector3d(0.5, 0.2, 0.0)).norm(), 0.0, 1e-4);
  EXPECT_NEAR((fit.correction.matrix - symmetric(1 / 1.1, 1, 1 / 0.95, 0, 0, 0)).norm(), 0.0, 1e-4);
  EXPECT_LT(fit.rms, 1e-5);
}

TEST(FitEllipsoid, FindsTheTruthBehindNoiseAndOutliers) {
  const Eigen::Matrix3d truth = symmetric(1.04, 0.97, 1.01, 0.02, -0.03, 0.015);
  const Eigen::Vector3d bias(30.0, -12.0, 400.0);
  std::mt19937 engine(7);
  std::normal_distribution<double> normal(0.0, 0.3);
  std::vector<LengthSample> samples;
  for (const auto& d : directions(400)) {
    const Eigen::Vector3d read = truth.inverse() * (48.0 * d) + bias;
    samples.push_back(
        {read + Eigen::Vector3d(normal(engine), normal(engine), normal(engine)), 0.3});
  }
  for (std::size_t i = 0; i < samples.size(); i += 12)
    samples[i].value += 25.0 * directions(400)[i];
  EllipsoidConfig config{.scale_sigma = 0.2, .skew_sigma = 0.2, .bias_sigma = 1.0};
  const EllipsoidFit fit = fit_ellipsoid(samples, fit_sphere(samples), config);
  const double shrink = std::cbrt(fit.correction.matrix.determinant() / truth.determinant());
  EXPECT_LT((fit.correction.matrix / shrink - truth).norm(), 0.005);
  EXPECT_LT((fit.correction.bias - bias).norm(), 0.2);
  EXPECT_NEAR(fit.outliers, 1.0 / 12.0, 0.01);
  EXPECT_LT(fit.rms, 0.01);
  EXPECT_GT(fit.rms_all, 0.05);
}

TEST(FitEllipsoid, KnowsWhereReadingsAreMissing) {
  std::vector<LengthSample> all;
  std::vector<LengthSample> upper;
  for (const auto& d : directions(200)) {
    all.push_back({d * 10.0, 0.02});
    if (d.z() > 0.3) upper.push_back(all.back());
  }
  const Sphere start{Eigen::Vector3d::Zero(), 10.0};
  const EllipsoidFit whole = fit_ellipsoid(all, start, {});
  const EllipsoidFit cap = fit_ellipsoid(upper, start, {});
  EXPECT_LT(whole.worst_sigma, 1e-3);
  EXPECT_GT(cap.worst_sigma, 5.0 * whole.worst_sigma);
  EXPECT_LT(cap.worst_direction.z(), -0.5);
}

TEST(FitEllipsoid, WithoutReadingsOnlyThePriorSpeaks) {
  const EllipsoidFit fit = fit_ellipsoid({}, {Eigen::Vector3d::Zero(), 10.0}, {});
  EXPECT_TRUE(fit.correction.matrix.isIdentity());
  EXPECT_GT(fit.worst_sigma, 0.2);
}

}  // namespace
}  // namespace vpdr::calibration
