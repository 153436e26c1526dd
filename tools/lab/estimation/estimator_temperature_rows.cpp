#include "tools/lab/estimation/estimator_temperature_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tools/lab/estimation/estimator_score.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {
namespace {

constexpr std::array<double, 3> kTemperatures_C = {24.0, 37.0, 50.0};  // facts papers D2
constexpr double kMostRatio = 1.2;
constexpr int kWarmUpSwings = 6;
constexpr double kSwing_rad = 1.0, kWarmUpSpeed_rad_s = 1.5, kAcceleration_rad_s2 = 10.0;
constexpr std::array<double, 3> kScoredSpeeds_rad_s = {0.3, 1.0, 2.0};
constexpr double kBegin_s = 1.0, kEnable_s = 2.0, kPause_s = 0.3;

/// Moves to and fro, one after the other; the script's length grows with each.
class SwingScript {
 public:
  SwingScript(const RobotConfig& robot, const std::string& preset, const SimOptions& sim)
      : script_{robot, preset, sim, {}, cycles(robot, kBegin_s)} {}

  void swing(double speed_rad_s) {
    move(kSwing_rad, speed_rad_s);
    move(-kSwing_rad, speed_rad_s);
  }
  std::int64_t now() const { return script_.cycles; }
  const RunScript& script() const { return script_; }

 private:
  static std::int64_t cycles(const RobotConfig& robot, double seconds) {
    return std::llround(seconds / robot.cycle_s);
  }
  void move(double target_rad, double speed_rad_s) {
    const bool first = script_.commands.empty();
    script_.commands.push_back(scripted(OperatorKind::kMoveJoint, script_.cycles));
    OperatorCommand& command = script_.commands.back();
    command.joint = 0;
    command.joint_target_rad = target_rad;
    command.joint_speed_rad_s = speed_rad_s;
    command.joint_acceleration_rad_s2 = kAcceleration_rad_s2;
    const double longest_s = 2.0 * kSwing_rad / speed_rad_s + speed_rad_s / kAcceleration_rad_s2 + kPause_s;
    script_.cycles += cycles(script_.robot, longest_s + (first ? kEnable_s : 0.0));
  }
  RunScript script_;
};

void refuse(const OperatorReply& reply) {
  if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed)
    throw std::runtime_error(std::string("the arm did not swing: ") + reply.reason);
}

TorqueScore score_at(double temperature_C, const RobotConfig& robot, const std::string& preset,
                     std::uint64_t seed, ExperimentReport& report) {
  SwingScript swings(robot, preset, SimOptions{seed, {{"temperature", temperature_C}}, true});
  for (int i = 0; i < kWarmUpSwings; ++i) swings.swing(kWarmUpSpeed_rad_s);
  const std::int64_t scored_from = swings.now();
  for (const double speed_rad_s : kScoredSpeeds_rad_s) swings.swing(speed_rad_s);
  TorqueScore score;
  run_in_process(
      swings.script(),
      [&](const CycleRecord& cycle) {
        const EstimatedJoint& joint = cycle.joint_state.joints[0];
        if (cycle.truth.stamp.seq >= scored_from && !joint.at_rest) score.add(joint, cycle.truth.joints[0]);
      },
      refuse);
  report.simulated_s += static_cast<double>(swings.now()) * robot.cycle_s;
  return score;
}

}  // namespace

void add_temperature_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                          ExperimentReport& report) {
  double best_Nm = std::numeric_limits<double>::infinity(), worst_Nm = 0.0;
  for (const double temperature_C : kTemperatures_C) {
    const double rms_Nm = score_at(temperature_C, robot, preset, seed, report).rms_Nm();
    best_Nm = std::min(best_Nm, rms_Nm);
    worst_Nm = std::max(worst_Nm, rms_Nm);
    report.rows.push_back({"estimator.temperature.rms_" + std::to_string(static_cast<int>(temperature_C)),
                           "Nm", rms_Nm, std::nullopt, std::nullopt, std::nullopt});
  }
  report.rows.push_back(
      {"estimator.temperature.ratio", "", worst_Nm / best_Nm, std::nullopt, std::nullopt, kMostRatio});
}

}  // namespace sprung
