#include "tools/lab/estimation/estimator_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tools/lab/estimation/estimator_ensemble.h"
#include "tools/lab/estimation/estimator_score.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

namespace {

using Part = JumpWindow::Part;

/// Noise of sim.yaml, and this jitter of the instant at which an encoder is read.
constexpr double kScoredJitter_us = 2.0;

/// One for each joint, in the robot's order.
struct JumpScores {
  std::vector<TorqueScore> push_off;
  std::vector<TorqueScore> landing;
  std::vector<TorqueScore> landed;  ///< landing without the impact itself
  std::vector<TorqueScore> jump;    ///< push-off, flight and landing
  std::vector<TorqueScore> moving;  ///< of these, where the joint is not taken to be at rest
  /// Before and after, while the estimate says that friction's sign is unknown.
  std::vector<TorqueScore> rest;
  bool fits = true;  ///< the estimator has believed its models all the time

  explicit JumpScores(std::size_t joints)
      : push_off(joints), landing(joints), landed(joints), jump(joints), moving(joints), rest(joints) {}
  void add(const JumpScores& other);
};

/// In which the impact's acceleration comes through the sampled encoder and the motion filter.
constexpr double kImpact_s = 0.008;

void add_cycle(Part part, double since_s, const JointState& estimated, const SimTruth& truth,
               JumpScores& scores) {
  for (std::size_t j = 0; j < truth.joints.size(); ++j) {
    scores.fits = scores.fits && estimated.joints[j].model_fits;
    const auto add_to = [&](std::vector<TorqueScore>& sums) {
      sums[j].add(estimated.joints[j], truth.joints[j]);
    };
    if (part == Part::kPushOff) add_to(scores.push_off);
    if (part == Part::kLanding) add_to(scores.landing);
    if (part == Part::kLanding && since_s >= kImpact_s) add_to(scores.landed);
    if (part != Part::kOther) add_to(scores.jump);
    if (part != Part::kOther && !estimated.joints[j].at_rest) add_to(scores.moving);
    if (part == Part::kOther && estimated.joints[j].at_rest) add_to(scores.rest);
  }
}

void add_each(std::vector<TorqueScore>& sums, const std::vector<TorqueScore>& others) {
  for (std::size_t j = 0; j < sums.size(); ++j) sums[j].add(others[j]);
}

void JumpScores::add(const JumpScores& other) {
  add_each(push_off, other.push_off);
  add_each(landing, other.landing);
  add_each(landed, other.landed);
  add_each(jump, other.jump);
  add_each(moving, other.moving);
  add_each(rest, other.rest);
  fits = fits && other.fits;
}

/// Stand, one hybrid jump, stand again, in process. @throws std::runtime_error where it did not jump and
/// land.
JumpScores score_jump(const RobotConfig& robot, const std::string& preset, const SimOptions& sim) {
  JumpScores scores(robot.joints.size());
  JumpWindow window;
  run_in_process(
      jump_script(robot, preset, sim, JumpMode::kHybrid, 1),
      [&](const CycleRecord& cycle) {
        const Part part = window.add(cycle.motion_state, cycle.truth);
        add_cycle(part, window.since_s(), cycle.joint_state, cycle.truth, scores);
      },
      [](const OperatorReply&) {});
  if (!window.complete()) throw std::runtime_error("the robot did not jump and land");
  return scores;
}

/// @throws std::invalid_argument where the robot has no joint of that name.
std::size_t joint_index(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
  }
  throw std::invalid_argument("robot " + robot.name + " has no joint '" + name +
                              "', which this experiment measures");
}

constexpr std::uint64_t kRuns = 5;
constexpr double kPushOff_Nm = 4.0, kPushOffWrong_Nm = 6.0, kLanding_Nm = 3.5, kLandingStiff_Nm = 8.0;
constexpr double kSoftGround_N_m = 8000.0, kStiffGround_N_m = 60000.0;

using Sums = std::vector<TorqueScore>;
using Changes = std::map<std::string, double>;

/// `base` with these changes too.
SimOptions changed(SimOptions base, std::uint64_t seed, const Changes& changes) {
  base.seed = seed;
  for (const auto& [key, value] : changes) base.plant[key] = value;
  base.plant.emplace("sync_jitter_us", kScoredJitter_us);
  return base;
}

JumpScores pooled(const RobotConfig& robot, const std::string& preset, const SimOptions& base,
                  const Changes& changes) {
  JumpScores all(robot.joints.size());
  for (std::uint64_t run = 1; run <= kRuns; ++run)
    all.add(score_jump(robot, preset, changed(base, 100 * base.seed + run, changes)));
  return all;
}

void add_estimator_row(ExperimentOutput& report, const std::string& name, const char* unit, double value,
                       std::optional<double> low = std::nullopt, std::optional<double> high = std::nullopt) {
  report.rows.push_back(row("estimator." + name, unit, value, {low, high}));
}

void add_torque_rows(ExperimentOutput& report, const RobotConfig& robot, const std::string& name,
                     const Sums& sums, double limit_Nm) {
  const TorqueScore& knee = sums[joint_index(robot, "knee")];
  add_estimator_row(report, name + ".rms", "Nm", knee.rms_Nm(), std::nullopt, limit_Nm);
  add_estimator_row(report, name + "_paper.rms", "Nm", knee.papers_rms_Nm());
  add_estimator_row(report, name + "_hip.rms", "Nm", sums[joint_index(robot, "hip")].rms_Nm());
}

TorqueScore over_joints(const Sums& sums) {
  TorqueScore all;
  for (const TorqueScore& sum : sums) all.add(sum);
  return all;
}

}  // namespace

void add_jump_rows(const RobotConfig& robot, const std::string& preset, const SimOptions& base,
                   ExperimentOutput& report) {
  const JumpScores soft = pooled(robot, preset, base, {{"ground_stiffness", kSoftGround_N_m}});
  TorqueScore whole = over_joints(soft.jump);
  add_torque_rows(report, robot, "pushoff", soft.push_off, kPushOff_Nm);
  for (const double off : {1.25, 0.75}) {
    const JumpScores wrong = pooled(robot, preset, base, {{"coulomb_scale", off}});
    whole.add(over_joints(wrong.jump));
    const std::string name = off > 1.0 ? "pushoff_friction_high" : "pushoff_friction_low";
    add_torque_rows(report, robot, name, wrong.push_off, kPushOffWrong_Nm);
  }
  add_torque_rows(report, robot, "landing", soft.landing, kLanding_Nm);
  add_estimator_row(report, "landing.rms_after_impact", "Nm",
                    soft.landed[joint_index(robot, "knee")].rms_Nm());
  const JumpScores stiff = pooled(robot, preset, base, {{"ground_stiffness", kStiffGround_N_m}});
  add_torque_rows(report, robot, "landing_stiff", stiff.landing, kLandingStiff_Nm);
  whole.add(over_joints(stiff.jump));
  add_estimator_row(report, "jump.coverage", "", whole.covered());
  add_estimator_row(report, "jump.half_width_over_rms", "", whole.mean_bound_Nm() / whole.rms_Nm());
}

void add_bounds_rows(const RobotConfig& robot, const std::string& preset, const SimOptions& base,
                     std::uint64_t ensemble, ExperimentOutput& report) {
  TorqueScore all, moving, rest;
  double plants = 0.0, fitting = 0.0;
  for (const EnsemblePlant& plant : estimator_plants(base, ensemble)) {
    const JumpScores scores = score_jump(robot, preset, changed(base, plant.seed, plant.changes));
    const TorqueScore jump = over_joints(scores.jump);
    add_estimator_row(report, "bounds." + plant.name + ".coverage", "", jump.covered(), 0.85);
    all.add(jump);
    moving.add(over_joints(scores.moving));
    rest.add(over_joints(scores.rest));
    plants += 1.0;
    fitting += scores.fits ? 1.0 : 0.0;
  }
  add_estimator_row(report, "bounds.model_fits", "", fitting / plants, 0.99);
  add_estimator_row(report, "bounds.pooled.coverage", "", all.covered(), 0.93, 0.985);
  add_estimator_row(report, "bounds.pooled.rms", "Nm", all.rms_Nm());
  add_estimator_row(report, "bounds.pooled.half_width", "Nm", all.mean_bound_Nm());
  add_estimator_row(report, "bounds.pooled.half_width_over_rms", "", all.mean_bound_Nm() / all.rms_Nm(),
                    std::nullopt, 2.6);
  // A viscous gear holds a leg still in the air, where all that is known of friction is what it can hold.
  add_estimator_row(report, "bounds.moving.half_width_over_rms", "",
                    moving.mean_bound_Nm() / moving.rms_Nm());
  add_estimator_row(report, "bounds.rest.coverage", "", rest.covered());
  add_estimator_row(report, "bounds.rest.half_width", "Nm", rest.mean_bound_Nm());
}

namespace {

constexpr std::array<double, 3> kTemperatures_C = {24.0, 37.0, 50.0};  // facts papers D2
constexpr double kMostOverBest = 1.2;
constexpr int kWarmUpSwings = 6;
constexpr double kSwing_rad = 1.0, kWarmUpSpeed_rad_s = 1.5, kAcceleration_rad_s2 = 10.0;
constexpr std::array<double, 3> kScoredSpeeds_rad_s = {0.3, 1.0, 2.0};
constexpr double kBegin_s = 1.0, kEnableAxis_s = 2.0, kPause_s = 0.3;

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
    script_.cycles += cycles(script_.robot, longest_s + (first ? kEnableAxis_s : 0.0));
  }
  RunScript script_;
};

void refuse(const OperatorReply& reply) {
  if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed)
    throw std::runtime_error(std::string("the arm did not swing: ") + reply.reason);
}

TorqueScore score_at(double temperature_C, const RobotConfig& robot, const std::string& preset,
                     std::uint64_t seed, ExperimentOutput& report) {
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
                          ExperimentOutput& report) {
  double best_Nm = std::numeric_limits<double>::infinity(), worst_Nm = 0.0;
  for (const double temperature_C : kTemperatures_C) {
    const double rms_Nm = score_at(temperature_C, robot, preset, seed, report).rms_Nm();
    best_Nm = std::min(best_Nm, rms_Nm);
    worst_Nm = std::max(worst_Nm, rms_Nm);
    report.rows.push_back(
        row("estimator.temperature.rms_" + std::to_string(static_cast<int>(temperature_C)), "Nm", rms_Nm));
  }
  report.rows.push_back(row("estimator.temperature.ratio", "", worst_Nm / best_Nm, at_most(kMostOverBest)));
}

}  // namespace sprung
