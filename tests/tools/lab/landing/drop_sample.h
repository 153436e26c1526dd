#pragma once
/// Landings that were made up: no simulation.
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/simulation.h"
#include "tools/lab/landing/drop.h"

namespace sprung {

/// Lets the script's leg fall for 0.2 s, land with this peak at the knee's gear output (half of it on the
/// motor side), and stand again, unless it folds.
inline void play_landing(const RunScript& script, double peak_Nm, bool folds, const CycleObserver& watch) {
  DriveState drives{2};
  JointState joints{2, 1};
  MotionState motion{1};
  DriveCommand commands{2};
  SimTruth truth{2, 1};
  LegCommand legs{1};
  for (int k = 0; k < 2; ++k)
    joints.joints[k].motor_side_torque_Nm = truth.joints[k].true_gear_output_torque_Nm = 0.0;
  joints.joints[1].motor_side_torque_Nm = 0.5 * peak_Nm;
  truth.joints[1].true_gear_output_torque_Nm = -peak_Nm;
  truth.joints[1].true_position_rad = 1.5;
  const std::int64_t release = release_cycle(script.robot, script.preset);
  for (int k = 0; k < 400; ++k) {
    const bool landed = k >= 200;
    truth.stamp.seq = release + k;
    truth.legs[0].true_foot_in_world_m[2] = landed ? 0.0 : 0.002 * (200 - k);
    truth.legs[0].true_contact_force_N[2] = landed ? 50.0 : 0.0;
    truth.base_in_world_m[2] = truth.legs[0].true_foot_in_world_m[2] + 0.5;
    motion.state = !landed            ? MotionPhase::kFlight
                   : k < 300 || folds ? MotionPhase::kLanding
                   : k < 350          ? MotionPhase::kRecover
                                      : MotionPhase::kStanding;
    watch({drives, joints, motion, commands, truth, legs});
  }
}

}  // namespace sprung
