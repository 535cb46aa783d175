#include "pdr/core/dead_reckoning/steady_start.hpp"

#include <cmath>

namespace vpdr::pdr {

namespace {
/// From one block to the next, uT.
constexpr double kLargestChange = 10.0;
}  // namespace

bool SteadyStart::has_settled(const MeanField& field) {
  if (settled_) return true;
  const bool alike = last_ && std::hypot((field.horizontal_ut - last_->horizontal_ut).norm(),
                                         field.up_ut - last_->up_ut) < kLargestChange;
  alike_ = alike ? alike_ + 1 : 1;
  ++blocks_;
  last_ = field;
  settled_ = alike_ >= kAlike || blocks_ >= kMost;
  return settled_;
}

}  // namespace vpdr::pdr
