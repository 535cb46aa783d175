#pragma once
// Loads the next frames in a thread of its own, so that decoding or rendering goes on beside what
// is done with the frames. The frames and their order are those of the source within.
#include <memory>

#include "vision/source/frame_source.hpp"

namespace vpdr::vision {

/// At most `depth` frames are loaded ahead.
std::unique_ptr<FrameSource> make_prefetching_source(std::unique_ptr<FrameSource> source,
                                                     std::size_t depth);

}  // namespace vpdr::vision
