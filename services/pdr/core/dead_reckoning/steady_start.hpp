#pragma once
// Whether a magnetometer has settled: its first readings may be what its registers held, and who
// takes them for the earth's field walks to a wrong north. Microtesla. Not thread-safe.
#include <optional>

#include "pdr/core/attitude/field_average.hpp"

namespace vpdr::pdr {

class SteadyStart {
 public:
  /// True from the fourth block in a row on that is like the one before, or the twentieth of all:
  /// whoever walks among steel from the start has no better ones.
  bool has_settled(const MeanField& field);

 private:
  static constexpr int kAlike = 4;
  static constexpr int kMost = 20;

  std::optional<MeanField> last_;
  int alike_ = 0;
  int blocks_ = 0;
  bool settled_ = false;
};

}  // namespace vpdr::pdr
