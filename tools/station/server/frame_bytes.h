#pragma once
/// A frame as a live page gets it. Pure.
#include <string>

#include "tools/station/frames/frames.h"

namespace sprung::station {

/// float64 time_s, then a float32 for each field, little endian; NaN = not measured.
std::string frame_bytes(const Frame& frame);

}  // namespace sprung::station
