#pragma once
// The magnetometer's offset: what is magnetised on the board or fixed to it (hard iron), learned
// while the body turns. In body axes the offset stands still, in the world the field does:
//   m = R' B + o,  hence  mean(m) - mean(R)' mean(R m) = (I - mean(R)' mean(R)) o,
// with weighted means over the recent past. Directions about which the body has not turned keep
// their prior, which widens with what is found in the others: offsets have no preferred direction.
// Readings that fit neither offset nor field count less, so that a magnet much stronger than the
// prior is not taken for an offset; unless an offset as strong as the earth's field explains nearly
// all of them, which no magnet on the way does: the board is not calibrated, and its prior widens.
// World axes (z up) and body axes, microtesla. Not thread-safe;
// allocates nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct MagneticOffsetConfig {
  double prior_sigma_ut = 3.0;   ///< uT, of each axis before the body has turned; (0.01, 1000)
  double memory_s = 12.0;        ///< s, over which readings are remembered; (1, 3600)
  double correlation_s = 3.0;    ///< s, over which the field's error stays alike; (0.01, 60)
  double least_sigma_ut = 1.75;  ///< uT, of the field from place to place; (0.01, 100)
  double spread_memory_s = 5.0;  ///< s, over which the misfit is judged; (0.1, 600)
};

class MagneticOffset {
 public:
  explicit MagneticOffset(const MagneticOffsetConfig& config);

  /// Adds a reading turned into the world that stands for the last `dt_s` seconds, with the
  /// rotation by which it was turned (a mean rotation will do).
  void add(const Eigen::Vector3d& field_world_ut, const Eigen::Matrix3d& world_from_body,
           double dt_s);
  /// Forgets the field and keeps the offset: after a gap the world is not where it was.
  void restart();
  /// Turns the memory with the world frame.
  void turn(const Eigen::Matrix3d& world_from_old_world);

  /// What a reading differs by from field and offset as known so far, world axes.
  [[nodiscard]] Eigen::Vector3d misfit_ut(const Eigen::Vector3d& field_world_ut,
                                          const Eigen::Matrix3d& world_from_body) const {
    return field_world_ut - field_ - world_from_body * offset_;
  }
  /// Variance of a misfit in each direction, uT^2.
  [[nodiscard]] double spread_ut2() const { return spread_ut2_; }
  [[nodiscard]] const Eigen::Vector3d& offset_ut() const { return offset_; }  ///< body axes
  /// Of the offset, body axes, uT^2.
  [[nodiscard]] const Eigen::Matrix3d& covariance_ut2() const { return covariance_; }
  /// Variance of each axis before the body has turned: an uncalibrated board shows itself.
  [[nodiscard]] double prior_ut2() const { return prior_ut2_; }
  /// Time that the means stand for, s; positive once a reading was added.
  [[nodiscard]] double weight_s() const { return weight_s_; }
  /// Mean field without the offset, world axes.
  [[nodiscard]] const Eigen::Vector3d& field_ut() const { return field_; }

 private:
  /// What the memory tells of the offset o: information o = moment, if nothing else were known.
  struct Normal {
    Eigen::Matrix3d information;
    Eigen::Vector3d moment_ut;
  };
  double weight_of(double misfit_ut2, double dt_s);
  void suspect_iron(const Normal& normal);
  [[nodiscard]] double misfit_ut2(const Normal& normal, const Eigen::Vector3d& offset_ut) const;

  MagneticOffsetConfig config_;
  double weight_s_ = 0.0;      ///< time that the means stand for
  double spread_ut2_;          ///< variance of one axis of the misfit
  double prior_ut2_;           ///< variance of one axis of the offset before the body has turned
  double strength_ut2_ = 0.0;  ///< mean square
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d world_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d body_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d prior_offset_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d field_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_;
};

}  // namespace vpdr::pdr
