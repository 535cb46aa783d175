#pragma once
// Tells when the board lies still, from the spread of gyroscope and accelerometer over consecutive
// short blocks. At rest the mean rate is the gyroscope's bias. Body axes, SI.
// Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace vpdr::pdr {

struct RestConfig {
  double block_s = 0.25;            ///< s, length of one block; (0.05, 2)
  int blocks = 6;                   ///< still blocks in a row that make a rest; 2 to 16
  double rate_std_radps = 0.02;     ///< rad/s, spread of each axis within a block; (0, 1)
  double rate_step_radps = 0.01;    ///< rad/s, between block means; (0, 1)
  double force_std_mps2 = 0.15;     ///< m/s^2, spread of each axis within a block; (0, 10)
  double force_step_mps2 = 0.15;    ///< m/s^2, between block means; (0, 10)
  double largest_bias_radps = 0.1;  ///< rad/s, a faster steady rate is a turn, not a bias; (0, 1)
};

class RestDetector {
 public:
  explicit RestDetector(const RestConfig& config);

  /// One sample that stands for `dt_s` seconds.
  void add(const Eigen::Vector3d& rate_radps, const Eigen::Vector3d& force_mps2, double dt_s);
  /// Forgets everything: after a gap nothing is known of rest.
  void reset();

  [[nodiscard]] bool at_rest() const { return at_rest_; }
  /// True once for every block that closes at rest; then mean_rate_radps() is new.
  [[nodiscard]] bool take_new_rest_block();
  /// Mean rate over the blocks of this rest, rad/s, body axes.
  [[nodiscard]] const Eigen::Vector3d& mean_rate_radps() const { return mean_rate_; }

 private:
  struct BlockMean {
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
  };
  static constexpr std::size_t kCapacity = 16;

  void close_block();
  void judge(const BlockMean& newest);

  RestConfig config_;
  // Sums are of differences to the block's first sample: squares of 9.8 would cost digits.
  Eigen::Vector3d rate_origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_sum_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_squares_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_sum_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_squares_ = Eigen::Vector3d::Zero();
  double elapsed_s_ = 0.0;
  int samples_ = 0;
  std::array<BlockMean, kCapacity> still_{};
  std::size_t still_count_ = 0;
  std::size_t next_ = 0;
  bool at_rest_ = false;
  bool new_block_ = false;
  Eigen::Vector3d mean_rate_ = Eigen::Vector3d::Zero();
};

}  // namespace vpdr::pdr
