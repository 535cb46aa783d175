#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "pdr/core/attitude/magnetic_offset.hpp"
#include "pdr/core/attitude/magnetic_reference.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kField(0.0, 20.0, -40.0);
const Vector3d kMagnet(5.0, -4.0, 3.0);

/// A reading of a level board that does not turn.
MagneticReference::Readings on_a_still_board(const Vector3d& field_ut) {
  MagneticReference::Readings readings;
  readings.field_ut = field_ut;
  return readings;
}

/// Turns about the vertical at 1 rad/s and rocks by `rock` rad; feeds `seconds` of readings.
struct Board {
  MagneticOffset offset{MagneticOffsetConfig{}};
  std::mt19937 random{5};
  double t = 0.0;

  void move(double seconds, double rate, double rock, const Vector3d& magnet,
            double noise_ut = 0.0) {
    std::normal_distribution<double> normal(0.0, 1.0);
    for (const double end = t + seconds; t < end; t += 0.04) {
      const Matrix3d world_from_body =
          from_euler({rock * std::sin(1.7 * t), rock * std::cos(1.1 * t), rate * t})
              .toRotationMatrix();
      const Vector3d noise(noise_ut * normal(random), noise_ut * normal(random),
                           noise_ut * normal(random));
      offset.add(kField + world_from_body * magnet + noise, world_from_body, 0.04);
    }
  }
};

TEST(MagneticOffset, TwoReadingsByHand) {
  // Half a turn about the vertical, offset 6 uT forward, prior 3 uT, spread 3 uT, two readings of
  // 6 s (one correlation time each) remembered for ever: the means are over 12 s, so their noise is
  // 9 * 6 / 12 = 4.5 uT^2 and prior / noise 4.5 / 9 = 0.5. mean(R) = diag(0, 0, 1):
  //   information = 1.5 - diag(0, 0, 1); x: (6 - 0) / 1.5 = 4 uT.
  MagneticOffsetConfig config;
  config.memory_s = 1e12;
  config.least_sigma_ut = 3.0;
  MagneticOffset offset(config);
  const Matrix3d ahead = Matrix3d::Identity();
  const Matrix3d back = from_euler({0.0, 0.0, kPi}).toRotationMatrix();
  const Vector3d magnet(6.0, 0.0, 0.0);
  offset.add(Vector3d(0.0, 0.0, -40.0) + ahead * magnet, ahead, 6.0);
  // Nothing is known yet: all of it is taken for field, and the other half turn fits it badly.
  EXPECT_NEAR(offset.offset_ut().norm(), 0.0, 1e-12);
  offset.add(Vector3d(0.0, 0.0, -40.0) + back * magnet, back, 6.0);
  // Its misfit of 12 uT counts for spread / misfit: 9 / 48 of 6 s, and widens the spread to 48.
  const double second = 6.0 * 9.0 / 48.0;
  const double share = second / (6.0 + second);
  const double mean = (1.0 - share) - share;  // of cos(yaw)
  const double noise = 48.0 * 6.0 / (6.0 + second);
  const double expected = (1.0 - mean * mean) * 6.0 / (1.0 + noise / 9.0 - mean * mean);
  EXPECT_NEAR(offset.offset_ut().x(), expected, 1e-9);
  EXPECT_NEAR(offset.offset_ut().y(), 0.0, 1e-12);
}

TEST(MagneticOffset, IsLearnedWhileTheBodyTurns) {
  Board board;
  board.move(60.0, 1.0, 0.6, kMagnet, 0.5);
  EXPECT_LT((board.offset.offset_ut() - kMagnet).norm(), 0.4 * kMagnet.norm());
  EXPECT_LT((board.offset.field_ut() - kField).norm(), 2.0);
  const double sigma = std::sqrt(board.offset.covariance_ut2().diagonal().maxCoeff());
  EXPECT_GT(3.0 * sigma, (board.offset.offset_ut() - kMagnet).cwiseAbs().maxCoeff());
  EXPECT_LT(sigma, 2.5);
}

TEST(MagneticOffset, AStillBodyTellsNothing) {
  Board board;
  board.move(60.0, 0.0, 0.0, kMagnet);
  EXPECT_LT(board.offset.offset_ut().norm(), 1e-9);
  EXPECT_NEAR(std::sqrt(board.offset.covariance_ut2()(0, 0)), 3.0, 0.01);
}

TEST(MagneticOffset, TurningAboutTheVerticalLeavesTheVerticalUnknown) {
  Board board;
  board.move(60.0, 1.0, 0.0, kMagnet);
  EXPECT_LT((board.offset.offset_ut() - kMagnet).head<2>().norm(), 0.4 * kMagnet.norm());
  EXPECT_NEAR(board.offset.offset_ut().z(), 0.0, 1e-9);
  // What is found of it level says how large it may be upright.
  const double prior_ut2 = 9.0 + board.offset.offset_ut().squaredNorm() / 3.0;
  EXPECT_NEAR(std::sqrt(board.offset.covariance_ut2()(2, 2)), std::sqrt(prior_ut2), 0.05);
}

TEST(MagneticOffset, FollowsAMagnetThatIsTakenOff) {
  Board board;
  board.move(60.0, 1.0, 0.6, kMagnet);
  board.move(90.0, 1.0, 0.6, Vector3d::Zero());
  EXPECT_LT(board.offset.offset_ut().norm(), 2.0);
}

TEST(MagneticOffset, KeepsTheOffsetOverAGap) {
  Board board;
  board.move(60.0, 1.0, 0.6, kMagnet);
  const Vector3d before = board.offset.offset_ut();
  board.offset.restart();
  board.move(5.0, 0.0, 0.0, kMagnet);
  EXPECT_LT((board.offset.offset_ut() - before).norm(), 0.1);
}

TEST(MagneticOffset, TurnsWithTheWorld) {
  Board board;
  board.move(30.0, 1.0, 0.6, kMagnet);
  const Vector3d before = board.offset.field_ut();
  const Matrix3d turn = from_euler({0.0, 0.0, 0.7}).toRotationMatrix();
  board.offset.turn(turn);
  EXPECT_LT((board.offset.field_ut() - turn * before).norm(), 1e-9);
  const Vector3d offset = board.offset.offset_ut();
  // The next reading, turned too, changes nothing but by its own small weight.
  board.offset.add(turn * (kField + kMagnet), turn, 1e-6);
  EXPECT_LT((board.offset.offset_ut() - offset).norm(), 1e-3);
}

TEST(MagneticReference, InnovationAndTiltRowByHand) {
  // Field 20 to the north, 40 down, seen from an estimate turned 0.1 rad too far clockwise: it lies
  // 0.1 rad east of north. Tilting the estimate about north by a angle e swings 40 e uT across: 40
  // / 20 = 2 rad of heading for each rad.
  MagneticReference reference{MagneticConfig{}};
  const Vector3d seen = from_euler({0.0, 0.0, -0.1}) * kField;
  const auto judgement = reference.judge(on_a_still_board(seen), 0.04);
  ASSERT_TRUE(judgement.usable);
  EXPECT_NEAR(judgement.innovation_rad, 0.1, 1e-12);
  EXPECT_NEAR(judgement.tilt_row.norm(), 2.0, 1e-12);
  EXPECT_NEAR(judgement.tilt_row.dot(seen.head<2>().normalized()), 2.0, 1e-12);
}

TEST(MagneticReference, TheDipNeverHidesTheTilt) {
  // What the row says is what happens: turn the measured field by a small tilt and compare.
  MagneticReference a{MagneticConfig{}};
  MagneticReference b{MagneticConfig{}};
  const Vector3d tilt(0.0002, -0.0003, 0.0);
  const auto level = a.judge(on_a_still_board(kField), 0.04);
  // The truth is tilted by `tilt` against the estimate: the field seen in the estimate's world.
  const auto tilted = b.judge(on_a_still_board(exp_rotation(-tilt) * kField), 0.04);
  EXPECT_NEAR(tilted.innovation_rad - level.innovation_rad, level.tilt_row.dot(tilt.head<2>()),
              1e-6);
}

TEST(MagneticReference, AMagnetIsSeenAndForgotten) {
  MagneticReference reference{MagneticConfig{}};
  const auto feed = [&](const Vector3d& field, double seconds) {
    MagneticReference::Judgement last;
    for (double t = 0.0; t < seconds; t += 0.04) {
      last = reference.judge(on_a_still_board(field), 0.04);
    }
    return last;
  };
  const double calm = feed(kField, 30.0).variance_rad2;
  EXPECT_FALSE(feed(kField + Vector3d(30.0, 30.0, 0.0), 5.0).usable);
  EXPECT_TRUE(reference.disturbed());
  EXPECT_FALSE(feed(kField, 0.04).variance_rad2 < 2.0 * calm) << "trusted again at once";
  EXPECT_LT(feed(kField, 20.0).variance_rad2, 2.0 * calm);
  EXPECT_FALSE(reference.disturbed());
}

TEST(MagneticReference, AStartBesideSteelIsRecognisedByTheCalibratedField) {
  const Vector3d steel = kField + Vector3d(12.0, 15.0, 8.0);
  MagneticReference innocent{MagneticConfig{}};
  MagneticReference calibrated{MagneticConfig{}};
  calibrated.expect({kField.head<2>().norm(), kField.z()});
  for (double t = 0.0; t < 20.0; t += 0.04) {
    ASSERT_TRUE(innocent.judge(on_a_still_board(steel), 0.04).usable) << t;
    ASSERT_FALSE(calibrated.judge(on_a_still_board(steel), 0.04).usable) << t;
  }
  EXPECT_TRUE(calibrated.judge(on_a_still_board(kField), 0.04).usable);
  EXPECT_FALSE(innocent.judge(on_a_still_board(kField), 0.04).usable);
}

TEST(MagneticReference, TheCalibratedFieldFadesToo) {
  MagneticReference reference{MagneticConfig{}};
  reference.expect({kField.head<2>().norm(), kField.z()});
  const Vector3d elsewhere = 1.4 * kField;
  for (double t = 0.0; t < 120.0; t += 0.04) reference.judge(on_a_still_board(elsewhere), 0.04);
  EXPECT_FALSE(reference.disturbed());
}

TEST(MagneticReference, TheCalibratedFieldWhereItHoldsChangesNothing) {
  MagneticReference reference{MagneticConfig{}};
  MagneticReference plain{MagneticConfig{}};
  reference.expect({kField.head<2>().norm(), kField.z()});
  for (double t = 0.0; t < 5.0; t += 0.04) {
    const auto a = reference.judge(on_a_still_board(kField), 0.04);
    const auto b = plain.judge(on_a_still_board(kField), 0.04);
    ASSERT_NEAR(a.variance_rad2, b.variance_rad2, 1e-12);
    ASSERT_NEAR(a.innovation_rad, b.innovation_rad, 1e-12);
  }
}

TEST(KnownField, IsLevelAndUpByHand) {
  const KnownField field = known_field(50.0, std::asin(0.8));
  EXPECT_NEAR(field.horizontal_ut, 30.0, 1e-12);
  EXPECT_NEAR(field.up_ut, -40.0, 1e-12);
  EXPECT_NEAR(field.disturbance_ut2(33.0, -36.0), 12.5, 1e-12);
}

TEST(MagneticReference, NoFieldIsWrongForEver) {
  MagneticReference reference{MagneticConfig{}};
  const Vector3d other(5.0, 30.0, -25.0);
  for (double t = 0.0; t < 30.0; t += 0.04) reference.judge(on_a_still_board(kField), 0.04);
  for (double t = 0.0; t < 120.0; t += 0.04) reference.judge(on_a_still_board(other), 0.04);
  EXPECT_FALSE(reference.disturbed());
}

}  // namespace
}  // namespace vpdr::pdr
