#pragma once
/// One run of a campaign: brings the robot into the drawn state, lets go wrong what was drawn, watches, and
/// tries to bring it back.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/vec3.h"
#include "tools/lab/campaign/draw.h"
#include "tools/lab/campaign/judge.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung::campaign {

struct Verdict {
  Draw draw;
  std::vector<Breach> breaches;
  SafetyCause cause = SafetyCause::kNone;  ///< the first that was named after the injection
  bool cause_expected = true;
  double noticed_s = kNaN;  ///< from the injection to the first level that is not operational
  double safe_s = kNaN;     ///< to the end of motors' torque, where it ended
  double fastest_share = 0.0, farthest_rad = 0.0, damping_work_J = 0.0;
  double peak_force_N = 0.0;  ///< on any foot, from the injection on
  bool recovered = false;
  std::string explained;  ///< where it was not: what the robot said
  std::string failure;    ///< the run itself could not be made: no verdict
  double simulated_s = 0.0;

  bool tripped() const noexcept { return cause != SafetyCause::kNone; }
  bool back_or_explained() const noexcept { return recovered || !explained.empty(); }
};

/// Never throws: what a run throws is its `failure`.
Verdict run_trial(const RobotConfig& robot, const std::string& preset, const Draw& draw);

/// Whether a script can hold the run: drives and buses go wrong alone, and the bridge is asked for nothing.
bool has_script(const Draw& draw) noexcept;
/// A run as commands and faults at fixed cycles, and how it ended.
struct ScriptedTrial {
  RunScript script;
  SimTruth end;
};
/// The run up to where it would be recovered: for real processes.
/// @throws std::runtime_error where the robot does not come to its state without `home`;
/// std::invalid_argument where has_script() is false.
ScriptedTrial script_of(const RobotConfig& robot, const std::string& preset, const Draw& draw);

}  // namespace sprung::campaign
