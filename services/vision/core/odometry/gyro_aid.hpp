#pragma once
// What the gyroscope's turn between two frames is worth: its remaining bias is learnt from what the
// camera saw of the same turns. Body axes, radians. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::vision {

struct GyroAidConfig {
  double bias_sigma_radps = 0.05;   ///< of the bias before anything is known
  double bias_walk_radps2 = 0.001;  ///< how fast it wanders, rad/s per square root of a second
  double noise_rad = 5e-4;          ///< of a turn between frames: time stamps, vibration
};

class GyroAid {
 public:
  explicit GyroAid(const GyroAidConfig& config = {});

  struct Turn {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< earlier from later body
    double sigma_rad = 0.0;                                        ///< about each axis
  };
  /// The turn with what is known of the bias taken off.
  [[nodiscard]] Turn corrected(const Eigen::Quaterniond& measured, double dt_s) const;
  /// Learns: the camera corrected `turn` (as given out for `dt_s`) by `correction_rad` (rotation
  /// vector, later body axes), and knows the result to `posterior_rad2`.
  void learn(const Turn& turn, double dt_s, const Eigen::Vector3d& correction_rad,
             const Eigen::Matrix3d& posterior_rad2);

  [[nodiscard]] const Eigen::Vector3d& bias_radps() const { return bias_; }

 private:
  GyroAidConfig config_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d variance_;  ///< of the bias
};

}  // namespace vpdr::vision
