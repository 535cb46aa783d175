#pragma once
// The direction in a carried device that tells where its owner goes. At first it is the device's
// forward axis; where that points up or down, or anywhere as in a pocket, it is what the shortest
// turn to upright leaves of it.
//
// People take a device from before the chest to the ear, into a pocket or down to the side as they
// walk, and walk on as before. While it moves the direction is held, and once it hangs steadily
// again, or after seconds in which a limb only swings it, it is found anew in the device. Whoever
// stands, or is not heard, may turn meanwhile: a device that then hangs in another way is taken up
// as at first. On the trunk nothing moves it.
//
// Attitudes are in a level frame that no magnetometer turns. SI. Not thread-safe; allocates
// nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/time.hpp"
#include "pdr/core/carry.hpp"

namespace vpdr::pdr {

class CarriedAxis {
 public:
  enum class News : std::uint8_t {
    kNone,
    kCarriedOn,  ///< in another way; the direction goes on, less surely
    kAnew        ///< taken up as at first
  };

  /// A device that tilts by more than `turned_over_rad` is carried in another way.
  CarriedAxis(double turned_over_rad, Carry carry);

  /// Stamps increase.
  void add(TimestampNs stamp_ns, const Eigen::Quaterniond& frame_from_body, bool walking);
  /// Seen from above, at the latest sample; short where it points up or down.
  [[nodiscard]] const Eigen::Vector2d& heading() const { return heading_; }
  /// What has happened to the direction since it was asked last; asked with each confirmed step,
  /// the first of which says that a walk has begun.
  News take_news();
  /// The forward axis itself, which points forward more likely than not.
  [[nodiscard]] bool is_forward_axis() const { return axis_.is_forward; }

 private:
  enum class State : std::uint8_t { kSteady, kMoving, kTrying };
  static constexpr std::size_t kPast = 6;  ///< headings a quarter of a second apart

  /// A direction in the device, and how the device hangs when it is that one.
  struct Axis {
    Eigen::Quaterniond body_from_axis = Eigen::Quaterniond::Identity();
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< body axes
    bool is_forward = true;
  };
  /// A direction in the device that is on trial, with sums of headings over the trial.
  struct Trial {
    Axis axis;
    Eigen::Vector2d heading = Eigen::Vector2d::Zero();
    Eigen::Vector2d old_heading = Eigen::Vector2d::Zero();
    double duration_s = 0.0;
  };

  void begin(const Eigen::Vector3d& up);
  void resume(const Eigen::Vector3d& up);
  void take_up(const Eigen::Vector3d& up);
  void average(const Eigen::Vector3d& up, double dt_s);
  void stand();
  void set_off();
  void walk(double dt_s);
  void hold();
  void try_out(const Eigen::Quaterniond& frame_from_body, double dt_s);
  void settle();
  void follow(const Eigen::Vector3d& up, const Eigen::Quaterniond& frame_from_body);
  void remember(double dt_s);
  [[nodiscard]] Eigen::Vector2d before() const;
  [[nodiscard]] bool hangs_as(const Axis& axis, double share = 1.0) const;

  double turned_over_;
  Carry carry_;
  bool started_ = false;
  TimestampNs last_ns_ = 0;

  Axis axis_;         ///< in use
  Axis walked_with_;  ///< in the last walk
  bool has_walked_ = false;
  bool is_new_ = false;  ///< the one in use: no walk knows it
  State state_ = State::kSteady;
  News news_ = News::kNone;
  Eigen::Vector2d heading_ = Eigen::Vector2d::UnitX();

  Eigen::Vector3d fast_up_ = Eigen::Vector3d::UnitZ();  ///< body axes, over half a second
  Eigen::Vector3d slow_up_ = Eigen::Vector3d::UnitZ();  ///< over a second
  double stood_s_ = 1e9;                                ///< since the last walk
  bool walks_ = false;                                  ///< with the axis in use

  std::array<Eigen::Vector2d, kPast> past_{};  ///< oldest first
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  double sum_s_ = 0.0;
  Eigen::Vector2d held_ = Eigen::Vector2d::UnitX();
  double moved_s_ = 0.0;  ///< since the direction is held
  Trial trial_;
};

}  // namespace vpdr::pdr
