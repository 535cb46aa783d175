#pragma once
// A recorded device, carried another way: readings as its sensors would have had them. The truth
// stays as it is.
#include "dataset/recording.hpp"

namespace vpdr::bench {

/// Held across: about its upward axis, counter-clockwise, from the beginning on.
void hold_across(dataset::Recording& recording, double angle_rad);

/// In the middle of the walk it is turned about its lateral axis within 0.8 s, forward axis down
/// where `angle_rad` is positive.
void turn_over(dataset::Recording& recording, double angle_rad);

}  // namespace vpdr::bench
