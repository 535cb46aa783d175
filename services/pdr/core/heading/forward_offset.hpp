#pragma once
// Walking direction against the device's own heading, from how the body moves. A walker's body
// rises over the standing leg and slows down, then falls and speeds up: kinetic and potential
// energy change places with every step, v_f a_f = -g v_z (Cavagna, Heglund and Taylor, "Mechanical
// work in terrestrial locomotion", American Journal of Physiology 233, 1977). So at the step
// frequency the forward acceleration is a quarter of a period ahead of the upward one, and with
//
//   A = sum a(t) e^(-i w t)     over four steps, w of the steps
//   d = Im(A_h conj A_z)        horizontal
//
// d points forward, whatever the device's attitude. Swaying sideways and swinging legs and arms
// have half that frequency. Running, both energies rise together and d points backward.
//
// One d is good to some 45 degrees, so they are added up as unit vectors relative to the device's
// yaw, old ones forgotten, and weighed against the belief that the device points forward, which is
// certain where the board is worn and absent in a pocket. A hand holds a device upright or across:
// one of its four sides points forward, though the surge of a hand is 20 degrees off. Angles ccw,
// rad. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>

#include "pdr/core/carry.hpp"
#include "pdr/core/steps/detected_step.hpp"

namespace vpdr::pdr {

struct ForwardOffsetConfig {
  double direction_sigma_rad = 0.8;  ///< rad, of one d; (0.01, 3)
  double common_sigma_rad = 0.15;    ///< rad, of all of them alike; (0, 3)
  double memory_steps = 80.0;        ///< steps over which they are remembered; (4, 1e4)
  double aligned_in_hand = 0.98;     ///< probability that the device points forward: hand; (0, 1)
  double aligned_unknown = 0.8;      ///< carried nobody knows where; (0, 1)
  double confidence = 0.98;          ///< that it does not, from which d is believed; (0.5, 1)
};

/// What the device's yaw lacks of the walking direction.
struct FoundOffset {
  double offset_rad = 0.0;
  double variance_rad2 = 0.0;
};

class ForwardOffset {
 public:
  ForwardOffset(const ForwardOffsetConfig& config, Carry carry);

  /// Attitude in a frame that is level, the device's heading in it, specific force in body axes.
  /// Stamps increase.
  void add(TimestampNs stamp_ns, const Eigen::Quaterniond& frame_from_body,
           const Eigen::Vector2d& heading, const Eigen::Vector3d& specific_force_mps2);
  /// With each confirmed step. Every fourth may tell the offset anew, once it is sure.
  std::optional<FoundOffset> take(const DetectedStep& step);
  /// The device is carried another way: what was found of it is void. Nothing is believed of it
  /// before, unless it may point forward.
  void carried_anew(bool may_point_forward);
  /// The same, and its heading is what it was but for `sigma_rad`: so are the directions found.
  void carried_on(double sigma_rad);

 private:
  struct Entry {
    TimestampNs stamp_ns = 0;
    Eigen::Vector3d force_mps2 = Eigen::Vector3d::Zero();  ///< level frame
    Eigen::Vector2d heading = Eigen::Vector2d::Zero();
  };
  static constexpr std::size_t kCapacity = 256;
  static constexpr TimestampNs kSpacing = 20'000'000;
  static constexpr int kWindowSteps = 4;

  /// Unit vector, against the mean heading.
  [[nodiscard]] std::optional<Eigen::Vector2d> direction(TimestampNs begin_ns,
                                                         TimestampNs end_ns) const;
  [[nodiscard]] const Entry& at(std::size_t age) const {
    return entries_[(next_ + kCapacity - 1 - age) % kCapacity];
  }
  [[nodiscard]] std::optional<FoundOffset> judge();
  [[nodiscard]] std::optional<FoundOffset> judge_sides();

  ForwardOffsetConfig config_;
  bool known_;   ///< worn where it points forward for certain
  bool anyhow_;  ///< carried where nothing is believed before
  bool in_hand_;
  bool has_sides_;           ///< one of its four sides points forward
  double side_rad_ = 0.0;    ///< that one, as found so far
  double first_log_odds_;    ///< of a device that is taken up to point forward
  double log_odds_aligned_;  ///< before anything was seen
  std::array<Entry, kCapacity> entries_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  Entry sum_;
  int samples_ = 0;

  TimestampNs window_begin_ns_ = 0;
  TimestampNs last_step_ns_ = 0;
  int window_steps_ = 0;
  Eigen::Vector2d directions_ = Eigen::Vector2d::Zero();  ///< their sum
  bool found_ = false;
};

}  // namespace vpdr::pdr
