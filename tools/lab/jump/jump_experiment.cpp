#include "tools/lab/jump/jump_experiment.h"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tools/lab/gait/voltage_reserve.h"
#include "tools/lab/jump/jump_report.h"

namespace sprung {

namespace {

constexpr std::int64_t kStandCycle = 100;       // the estimator has settled by then
constexpr const char* kFloor = "floor_height";  // key of --plant

struct JumpCase {
  std::string preset;
  JumpMode mode;
};

constexpr const char* kEveryMode = "all";

/// The papers' three under the preset that was asked for; own, and position to compare it with, under `best`
/// where there is one. Or one alone.
std::vector<JumpCase> cases(const std::string& preset, const std::string& best, const std::string& mode) {
  if (mode != kEveryMode) return {{preset, named(kJumpModes, mode)}};
  std::vector<JumpCase> out = {
      {preset, JumpMode::kPosition}, {preset, JumpMode::kTorque}, {preset, JumpMode::kHybrid}};
  if (preset != best) out.push_back({best, JumpMode::kPosition});
  out.push_back({best, JumpMode::kAdaptive});
  return out;
}

double floor_m(const SimOptions& sim) {
  const auto change = sim.plant.find(kFloor);
  return change == sim.plant.end() ? 0.0 : change->second;
}

void add_jump(const RunScript& script, JumpMode mode, const ScriptRunner& run, JumpExperiment& out) {
  JumpMetrics metrics(script.robot, floor_m(script.sim));
  JumpTrace trace(script.robot);
  VoltageReserveWatch reserve(script.robot, script.sim);
  run(
      script,
      [&](const CycleRecord& cycle) {
        metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth, &cycle.leg_command);
        trace.add(cycle);
        reserve.add(cycle.truth);
      },
      throw_unless_obeyed);
  if (metrics.jumps().empty()) {
    throw std::runtime_error("the robot never began to jump");
  }
  out.jumps.push_back({script.preset, mode, metrics.jumps().front(), reserve.result().least});
  out.samples.push_back(trace.samples());
  out.simulated_s += static_cast<double>(script.cycles) * script.robot.cycle_s;
}

}  // namespace

RunScript jump_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      JumpMode mode, int count) {
  const PresetConfig& p = robot.preset(preset);
  const double stand_s = p.rise_time_s + 2.0;  // enabling, rising, settling
  const double jump_s = p.crouch_time_s + 2 * p.settle_time_s + p.thrust_timeout_s + p.flight_timeout_s +
                        p.landing_hold_s + p.recover_time_s;
  RunScript script{robot, preset, sim, {}, 0};
  const auto cycles = [&](double seconds) { return std::llround(seconds / robot.cycle_s); };
  script.commands.push_back(scripted(OperatorKind::kStand, kStandCycle));
  script.commands.push_back(scripted(OperatorKind::kJump, cycles(stand_s)));
  script.commands.back().jump_mode = mode;
  script.commands.back().jump_count = count;
  script.cycles = cycles(stand_s + count * jump_s + 0.5);
  return script;
}

JumpExperiment run_jump_experiment(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                   const ScriptRunner& run, const std::string& mode) {
  JumpExperiment out;
  out.preset = preset;
  for (const JumpCase& jump : cases(preset, preset_or(robot, "best", preset), mode))
    add_jump(jump_script(robot, jump.preset, sim, jump.mode, 1), jump.mode, run, out);
  out.rows = jump_rows(out.jumps, preset);
  return out;
}

Experiment jump_experiment() {
  Experiment out;
  out.name = "jump";
  out.what =
      "One jump in position, torque and hybrid control beside the paper's numbers, and one with sprung's own "
      "landing.";
  out.question =
      "Are the paper's jumps met in position, torque and hybrid control, and what does adaptive landing "
      "save?";
  out.presets.in_all = "paper";
  out.preset_note = "; paper reproduces the paper";
  out.takes = {Common::kPreset, Common::kPlant, Common::kSeparate, Common::kOut};
  out.example = "--robot single_leg --preset paper --seed 3 --out logs/jump";
  out.in_all = {RobotKind::kLeg};
  const auto mode = std::make_shared<std::string>(kEveryMode);
  std::vector<std::string> modes = names(kJumpModes);
  modes.emplace_back(kEveryMode);
  out.own.choice("--mode", *mode, modes, "one alone, under the preset");
  out.run = [mode](const ExperimentInput& in) {
    const JumpExperiment result = run_jump_experiment(in.robot, in.preset, in.sim, in.run, *mode);
    return ExperimentOutput{result.rows, result.simulated_s, jump_sections(in.robot, in.sim, result)};
  };
  return out;
}

}  // namespace sprung
