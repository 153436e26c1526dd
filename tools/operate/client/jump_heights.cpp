#include "tools/operate/client/jump_heights.h"

#include <cmath>
#include <cstdio>

namespace sprung {

std::vector<std::string> JumpHeights::add(const sprung_msgs::motion_state_t& motion) {
  std::vector<std::string> lines;
  // A request begins to count anew, so that fewer are none of the jumps before it.
  if (done_ >= 0 && motion.jumps_done > done_) {
    for (int jump = done_ + 1; jump < motion.jumps_done; ++jump)
      lines.push_back("jump " + std::to_string(jump) + ": height not heard, its message was lost on the way");
    lines.push_back(line(motion.jumps_done, motion.estimated_jump_height_m));
  }
  done_ = motion.jumps_done;
  return lines;
}

std::string JumpHeights::line(int jump, double height_m) const {
  const std::string begin = "jump " + std::to_string(jump) + ": ";
  if (!std::isfinite(height_m)) return begin + "height unknown: lift-off or touchdown was not measured";
  char text[128];
  std::snprintf(text, sizeof text, "%.0f mm high", 1e3 * height_m);
  std::string asked;
  if (asked_m_ > 0.0) asked = " (asked " + std::to_string(std::lround(1e3 * asked_m_)) + " mm)";
  return begin + text + asked + ", estimated from flight time and leg lengths";
}

}  // namespace sprung
