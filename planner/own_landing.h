#pragma once
/// sprung's own landing (JumpMode::kOwn) of one leg: from lift-off, or from the beginning of a fall, to the end of the landing.
/// What jump and fall plan (`planned`) is the hybrid law's; this law may go along with it, or leave it to meet the ground
/// softer. Pure; time is the message's.
#include <cstdint>

#include "planner/ballistics.h"
#include "planner/foot_move.h"
#include "planner/leg_gains.h"
#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

struct OwnLandingInput {
  std::int64_t utime_us = 0;
  FootPoint planned;  ///< where jump or fall would have the foot now
  JumpProgress progress;
  EstimatedLeg measured;  ///< foot, its velocity and force, contact
};

struct OwnLandingOutput {
  FootPoint desired;
  ControlMode control_mode = ControlMode::kPosition;
  StiffnessConfig gains;  ///< in compliance
  Vec3 feedforward_force_N{0, 0, 0};
  double friction_compensation = 0.0;
  double inertia_compensation = 0.0;
};

class OwnLanding {
 public:
  OwnLanding(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset);

  /// Flight begins.
  void begin(const ExpectedTouchdown& expected) noexcept;
  /// Once a cycle, in flight and landing. @param in.progress.phase says which; kLanding from the cycle of the measured touchdown.
  OwnLandingOutput step(const OwnLandingInput& in) noexcept;

 private:
  PresetConfig preset_;
  ExpectedTouchdown expected_;
};

}  // namespace sprung
