#pragma once
// Position from step length and walking direction: x += SL cos(theta), y += SL sin(theta) with a
// mathematical angle (S1.3). The AHRS paper's form (S3.5: 8, 9: north 0, clockwise, first direction
// +Y, X from the sine and Y from the cosine) is a view of the same state.
//
// Covariance: a wrong step length of the person and a slowly changing heading error are common to
// all steps, so they are carried as consider states next to the position (x, y, heading error, step
// scale error) and never average out; only what differs from step to step does.
// World ENU, metres, radians. Not thread-safe; allocates nothing.
#include <Eigen/Core>

namespace vpdr::pdr {

struct DeadReckoningConfig {
  double heading_correlation_s = 60.0;  ///< s, over which the heading error stays alike; (0.1, 1e5)
  double sway_sigma_m = 0.05;           ///< m, of the body about where its steps put it; (0, 1)
  /// m, how far ahead the walker may be for each step that is not confirmed yet, and one; (0, 10)
  double unconfirmed_sigma_m = 0.5;
  double height_sigma_m = 0.5;  ///< m, of the height, which steps do not tell; (0, 100)
  double height_drift = 0.05;   ///< m of height per m walked: slopes, stairs; (0, 1)
};

/// One step as dead reckoning needs it.
struct DeadReckonedStep {
  double length_m = 0.0;
  double yaw_rad = 0.0;            ///< walking direction, mathematical angle
  double elapsed_s = 0.0;          ///< since the step before
  double scale_sigma = 0.0;        ///< share of the length, the same for all steps
  double length_noise_m = 0.0;     ///< of this step alone
  double heading_sigma_rad = 0.0;  ///< slowly changing part
  double heading_noise_rad = 0.0;  ///< of this step alone
};

class DeadReckoning {
 public:
  explicit DeadReckoning(const DeadReckoningConfig& config = {}) : config_(config) {}

  /// S1.3.
  void add(const DeadReckonedStep& step);
  /// North became known: the track so far is turned about its start.
  void turn(double angle_rad);

  /// East and north of the start, m.
  [[nodiscard]] Eigen::Vector2d position_m() const { return position_; }
  [[nodiscard]] Eigen::Matrix2d covariance_m2() const { return covariance_.topLeftCorner<2, 2>(); }
  [[nodiscard]] double height_variance_m2() const;
  /// Error of east and north that goes with one standard deviation of heading error, m.
  [[nodiscard]] Eigen::Vector2d heading_leverage_m() const;

  /// S3.5 (6): straight from the start, m.
  [[nodiscard]] double distance_m() const { return position_.norm(); }
  /// S3.5 (7): along the path, m.
  [[nodiscard]] double path_length_m() const { return path_length_; }

  /// S3.5 (8): turn since the first step, theta_k = phi_k - phi_1, clockwise, [0, 2 pi).
  [[nodiscard]] double compass_turn_rad() const;
  /// S3.5 (9): X to the right of the first step's direction, Y along it, m.
  [[nodiscard]] Eigen::Vector2d compass_position_m() const;

 private:
  DeadReckoningConfig config_;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();  ///< x, y, heading error, scale error
  double path_length_ = 0.0;
  double first_yaw_ = 0.0;
  double last_yaw_ = 0.0;
  bool started_ = false;
};

/// S3.5 (10): Euclidean distance of an estimate from the truth, m.
double position_error_m(const Eigen::Vector2d& estimate_m, const Eigen::Vector2d& truth_m);

}  // namespace vpdr::pdr
