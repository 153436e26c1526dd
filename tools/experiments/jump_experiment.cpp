#include "tools/experiments/jump_experiment.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "tools/experiments/jump_metrics.h"

namespace sprung {

namespace {

/// Facts A2; NaN where S0 gives no number.
struct PaperJump {
  double height_mm, touchdown_ms, peak_hip_Nm, peak_knee_Nm, landing_knee_Nm;
};

PaperJump paper_figures(JumpMode mode) {
  switch (mode) {
    case JumpMode::kPosition:
      return {184, 550, 151.84, 162.72, 61.58};
    case JumpMode::kTorque:
      return {110, 460, 57.98, 107.84, 24.21};
    case JumpMode::kHybrid:
      return {188, 576, 145.42, 164.74, 9.46};
    case JumpMode::kOwn:
      break;
  }
  return {kNaN, kNaN, kNaN, kNaN, kNaN};
}

constexpr double kLeastHybridHeight_mm = 150.0;  // what this stack promises on its own plant

constexpr std::int64_t kStandCycle = 100;  // the estimator has settled by then

ReportRow row(JumpMode mode, const char* quantity, const char* unit, double value,
              std::optional<double> paper) {
  return {std::string("jump.") + name(mode) + "." + quantity, unit, value, paper, std::nullopt, std::nullopt};
}

void add_rows(ExperimentReport& report, JumpMode mode, const JumpResult& jump) {
  const PaperJump paper = paper_figures(mode);
  report.rows.push_back(row(mode, "height", "mm", jump.height_mm, paper.height_mm));
  if (mode == JumpMode::kHybrid) {
    report.rows.back().low = kLeastHybridHeight_mm;
  }
  report.rows.push_back(row(mode, "touchdown_time", "ms", jump.touchdown_time_ms, paper.touchdown_ms));
  report.rows.push_back(row(mode, "peak_knee_torque", "Nm", jump.peak_knee_torque_Nm, paper.peak_knee_Nm));
  report.rows.push_back(row(mode, "peak_hip_torque", "Nm", jump.peak_hip_torque_Nm, paper.peak_hip_Nm));
  report.rows.push_back(
      row(mode, "peak_knee_output_torque", "Nm", jump.peak_knee_output_torque_Nm, std::nullopt));
  report.rows.push_back(
      row(mode, "landing_knee_torque", "Nm", jump.landing_knee_torque_Nm, paper.landing_knee_Nm));
  report.rows.push_back(
      row(mode, "landing_knee_output_torque", "Nm", jump.landing_knee_output_torque_Nm, std::nullopt));
}

JumpResult one_jump(const RunScript& script, const ScriptRunner& run) {
  JumpMetrics metrics(script.robot);
  run(
      script,
      [&](const CycleRecord& cycle) { metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth); },
      [](const OperatorReply& reply) {
        if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed) {
          throw std::runtime_error(std::string("the robot ") + name(reply.outcome) +
                                   " a command: " + reply.reason);
        }
      });
  if (metrics.jumps().empty()) {
    throw std::runtime_error("the robot never began to jump");
  }
  return metrics.jumps().front();
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

ExperimentReport run_jump_experiment(const RobotConfig& robot, const std::string& preset,
                                     const SimOptions& sim, const ScriptRunner& run) {
  ExperimentReport report;
  report.experiment = "jump";
  report.robot = robot.name;
  report.preset = preset;
  report.seed = sim.seed;
  const auto started = std::chrono::steady_clock::now();
  for (const JumpMode mode : {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid}) {
    const RunScript script = jump_script(robot, preset, sim, mode, 1);
    add_rows(report, mode, one_jump(script, run));
    report.simulated_s += static_cast<double>(script.cycles) * robot.cycle_s;
  }
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return report;
}

}  // namespace sprung
