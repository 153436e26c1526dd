#pragma once
/// Stands on the links between the cores of a robot in one process: what a bad network, a broken program or a
/// stranger on the bus does. For experiments and tests.
#include "drivers/can/can_frame.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/operator.h"
#include "signals/sensors.h"

namespace sprung {

/// Nothing here throws. What is changed is what the receiver hears; the sender's own copy stays.
class InProcessLinks {
 public:
  virtual ~InProcessLinks() = default;

  /// May change the message on its way. @return false: it is lost.
  virtual bool pass(DriveState&) noexcept { return true; }
  virtual bool pass(JointState&) noexcept { return true; }
  virtual bool pass(LegCommand&) noexcept { return true; }
  virtual bool pass(DriveCommand&) noexcept { return true; }
  virtual bool pass(Imu&) noexcept { return true; }
  /// What an operator asks for, when it is given to the robot.
  virtual void ordered(const OperatorCommand&) noexcept {}
  /// What the drives said in this cycle.
  virtual void answered(const FrameBatch&) noexcept {}
  /// The bridge's frames of this cycle, as they go to the drives.
  virtual void sent(const FrameBatch&) noexcept {}
  /// Frames of somebody else on the buses; drives and bridge hear them behind those of the bridge.
  virtual void add_foreign(FrameBatch&) noexcept {}
};

}  // namespace sprung
