#pragma once
/// Whether legs can follow a jump's curve: their stroke, and their drives' speed and torque. Pure; no heap
/// after construction.
#include <memory>
#include <vector>

#include "model/leg_kinematics.h"
#include "model/transmission.h"
#include "planner/jump_curve.h"

namespace sprung {

class JumpReach {
 public:
  /// @throws std::invalid_argument on kinematics or a transmission that cannot be.
  explicit JumpReach(const RobotConfig& robot);
  ~JumpReach();

  /// Static text: a point that no pose reaches or that is beyond a joint's limits; a drive that would have to
  /// turn faster than its speed limit; one whose torque limit, over the whole push-off, gives less work than
  /// its own rotor's motion holds. nullptr: it can be followed. Drives may lag behind a curve that asks for
  /// more torque than they have for a while.
  const char* validate(const JumpCurve& curve) const noexcept;

 private:
  struct Leg;
  std::vector<Leg> legs_;
};

}  // namespace sprung
