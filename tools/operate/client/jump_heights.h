#pragma once
/// What the motion planner says of the height of each jump, in lines for an operator, as the jumps land.
/// Pure.
#include <string>
#include <vector>

#include "sprung_msgs/motion_state_t.hpp"

namespace sprung {

/// Fed with every MOTION_STATE that is heard, from before the jump was asked for.
class JumpHeights {
 public:
  /// @param asked_m as in the command: 0 = the preset's own jump, which is not compared with.
  explicit JumpHeights(double asked_m) : asked_m_(asked_m) {}

  /// A line for each jump that has landed since the message before: "jump 1: 186 mm high (asked 150 mm),
  /// estimated from flight time and leg lengths". Of several, when messages were lost, only the last one's
  /// height was heard.
  std::vector<std::string> add(const sprung_msgs::motion_state_t& motion);

 private:
  std::string line(int jump, double height_m) const;

  double asked_m_;
  int done_ = -1;  ///< jumps in the message before; -1 = there was none
};

}  // namespace sprung
