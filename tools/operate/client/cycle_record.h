#pragma once
/// What one cycle of the whole stack produced, whichever way it was run.
#include <functional>

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/simulation.h"

namespace sprung {

struct CycleRecord {
  const DriveState& drive_state;
  const JointState& joint_state;
  const MotionState& motion_state;
  const DriveCommand& drive_command;
  const SimTruth& truth;
  const LegCommand& leg_command;  ///< of this cycle: used in the next
};
using CycleObserver = std::function<void(const CycleRecord&)>;
using ReplyObserver = std::function<void(const OperatorReply&)>;

}  // namespace sprung
