#pragma once
// The part of the horizon's error that never averages out: the accelerometer's offset and how it
// is mounted. Over a while a person rises and sinks by little, so that the mean of the vertical
// specific force is gravity and the offset's vertical part. An offset has no preferred direction:
// what is seen of it upright tells the size of what cannot be seen, the level parts, which tilt the
// horizon. SI, rad. Not thread-safe; allocates nothing.

namespace vpdr::pdr {

struct HorizonBaseConfig {
  double sigma_rad = 0.025;  ///< rad, each axis, before anything was seen; (0, 1)
  /// Share of that variance which stays: one direction seen tells two others only so well; (0, 1]
  double kept_share = 0.06;
  double memory_s = 30.0;  ///< s, over which the vertical force is averaged; (1, 3600)
};

class HorizonBase {
 public:
  explicit HorizonBase(const HorizonBaseConfig& config) : config_(config) {}

  /// What vertical specific force summed up to over the last `duration_s`, m/s.
  void add(double up_velocity_mps, double duration_s);

  /// Of each tilt, rad^2.
  [[nodiscard]] double variance_rad2() const;

 private:
  HorizonBaseConfig config_;
  double surplus_mps2_ = 0.0;  ///< mean of the vertical force beyond gravity
  double weight_s_ = 0.0;      ///< time that it stands for
};

}  // namespace vpdr::pdr
