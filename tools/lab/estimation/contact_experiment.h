#pragma once
/// Rows `estimator.contact.*`: is contact found, how late, and is it reported where there is none? Jumps of a
/// leg in every mode, and the same leg suspended and stepping onto a floor whose height moves at random, or
/// onto none. Of a robot that walks: walking_estimate.h.
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/simulation.h"
#include "simulation/sim_core.h"
#include "tools/lab/estimation/contact_scorer.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct ContactRequest {
  std::string preset;              ///< empty = the robot's usual one
  std::vector<SimOptions> plants;  ///< each of them jumps and steps
  int steps_per_plant = 40;
  bool jumps = true;  ///< one in each mode
};

/// Every cycle of a suspended leg that steps (stepping_leg.h) as many times; `step_begins` in a step's first.
using SteppingObserver = std::function<void(const JointState& estimate, const SimTruth& truth,
                                            bool step_begins)>;
/// @throws std::runtime_error where the plant failed or the leg does not move.
void run_stepping(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int steps,
                  const SteppingObserver& on_cycle);

/// Of one plant, in order. @throws std::runtime_error where the plant or a command failed.
std::vector<ContactStep> jump_contacts(const RobotConfig& robot, const std::string& preset,
                                       const SimOptions& sim);
std::vector<ContactStep> stepping_contacts(const RobotConfig& robot, const std::string& preset,
                                           const SimOptions& sim, int steps);

/// All of `request`. Each plant's ground is the next of 8, 15, 30 and 60 kN/m and its encoders are read with
/// 2 us of jitter, unless its changes say otherwise.
std::vector<ContactStep> run_contacts(const RobotConfig& robot, const ContactRequest& request);
/// found, delay_median_fast, _medium, _slow and false_alarms, with the bounds demanded of them.
std::vector<ReportRow> contact_rows(const std::vector<ContactStep>& steps);

}  // namespace sprung
