#pragma once
// Steps that are announced and neither confirmed nor withdrawn. Until then the walker has made each
// of them with its probability p, so the position is moved by p of it and is unsure by what the
// mean of "a step" and "none" leaves open. World ENU, m. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "core/estimates.hpp"

namespace vpdr::pdr {

class TentativeSteps {
 public:
  /// Nobody confirms or withdraws: the oldest are forgotten.
  void add(const StepEvent& step);
  /// The step of that stamp, which is no longer kept.
  std::optional<StepEvent> take(TimestampNs stamp_ns);

  [[nodiscard]] std::size_t size() const { return count_; }
  /// Mean of the way they are worth, turned by what the zero of yaw was revised by since: its
  /// revision now, as in HeadingEstimate.
  [[nodiscard]] Eigen::Vector2d displacement_m(double revision_rad) const;
  /// And its covariance: sqrt(p (1 - p)) l adds up over them, for either all of them are steps of
  /// one walk or none is; p sigma^2 is new with each.
  [[nodiscard]] Eigen::Matrix2d covariance_m2(double revision_rad) const;

 private:
  std::array<StepEvent, 8> steps_{};
  std::size_t count_ = 0;
};

}  // namespace vpdr::pdr
