#pragma once
/// Where a robot in motion would come to rest over its feet (Hof 2008), and how far that is beyond them.
/// Level axes. Pure.
#include "planner/gait/body_view.h"

namespace sprung {

/// A body in motion is as near to tipping as one at rest that is its speed times this further on.
double capture_s(const BodyView& view, std::size_t legs) noexcept;
/// Seen from above, of the capture point from the polygon about all feet, also those in the air; negative
/// inside. Beyond a corner it is less than the distance. Fewer than three feet, or one that is not known:
/// NaN.
double beyond_feet_m(const BodyView& view, std::size_t legs) noexcept;
/// The same as a share of the trunk's height over its feet; NaN where height or speed is not known.
double capture_beyond(const JointState& in, const BodyShape& shape) noexcept;

}  // namespace sprung
