#pragma once
/// The guided procedure on a robot that `sprung up` runs: watched, recorded, and ended safely whatever
/// happens.
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/identify/record_protocol.h"
#include "tools/operate/client/joint_mover.h"

namespace sprung::identify {

/// What is going to happen.
struct RecordPlan {
  int joint = -1;
  RecordRange range;
  double from_rad = 0.0;
  std::vector<RecordMove> moves;
};

/// Waits up to a second for joints that are starting. @throws std::runtime_error saying what to do first: no
/// JOINT_STATE, safety not operational, a joint that is not referenced or not ready. std::invalid_argument
/// where nothing is left to move in.
RecordPlan plan_recording(const RobotConfig& robot, int joint, const RecordOptions& options,
                          JointMover& mover);

/// For people, before they say yes: what moves, how far, how fast, how long, and what holds still.
std::string describe(const RobotConfig& robot, const RecordPlan& plan);

struct SessionResult {
  bool complete = false;
  std::string reason;  ///< why not
};

/// Moves through the plan, then lets go (`sit`: damped, then off). After Ctrl-C, a refused or failed move,
/// lost safety or silence it lets go at once; a second Ctrl-C ends the wait for that.
/// @param tell gets a line now and then.
SessionResult carry_out(const RecordPlan& plan, JointMover& mover,
                        const std::function<void(const std::string&)>& tell);

}  // namespace sprung::identify
