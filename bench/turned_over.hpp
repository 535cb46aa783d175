#pragma once
// A recorded device, carried another way from the middle of the walk on.
#include "dataset/recording.hpp"

namespace vpdr::bench {

/// Turns it about its lateral axis within 0.8 s, forward axis down where `angle_rad` is positive:
/// readings as its sensors would have had them. The truth stays as it is.
void turn_over(dataset::Recording& recording, double angle_rad);

}  // namespace vpdr::bench
