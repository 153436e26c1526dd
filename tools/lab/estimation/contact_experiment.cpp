#include "tools/lab/estimation/contact_experiment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "signals/quantile.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/estimation/stepping_leg.h"
#include "tools/lab/gait/legged_trial.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

namespace {

constexpr std::size_t kSteppingLeg = 0;
constexpr double kGrounds_N_m[] = {8000.0, 15000.0, 30000.0, 60000.0};
constexpr double kJitter_us = 2.0;
constexpr double kLongestStep_s = 9.0;  // at 0.08 m/s, with its waits

constexpr double kLeastFound_percent = 99.0;
constexpr double kMostFalseAlarms_percent = 0.5;
constexpr double kWalkingDelay_ms = 10.0;
constexpr struct {
  ApproachClass approach;
  double most_ms;
} kDelays[] = {{ApproachClass::kFast, 5.0}, {ApproachClass::kMedium, 10.0}, {ApproachClass::kSlow, 20.0}};

void append(std::vector<ContactStep>& all, const std::vector<ContactStep>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void move_floor(InProcessRobot& robot, double height_m) {
  SimControl floor;
  floor.kind = SimControlKind::kFloor;
  floor.value = height_m;
  robot.sim().control(floor);
}

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : kNaN;
}

double median_of(std::vector<double> values) { return quantile(std::move(values), 0.5); }

struct Counts {
  std::size_t touchdowns = 0, found = 0, false_alarms = 0;
};

Counts count(const std::vector<ContactStep>& steps) {
  Counts out;
  for (const ContactStep& step : steps) {
    out.touchdowns += step.approach_speed_m_s ? 1 : 0;
    out.found += step.delay_ms ? 1 : 0;
    out.false_alarms += step.false_alarm ? 1 : 0;
  }
  return out;
}

/// All legs of a walking robot: a step begins where the planner lifts the foot.
class WalkScorer {
 public:
  explicit WalkScorer(std::size_t legs) : last_(legs, LegPhase::kIdle) {
    for (std::size_t leg = 0; leg < legs; ++leg) scorers_.emplace_back(leg);
  }

  void add(const InProcessRobot& robot) {
    for (std::size_t leg = 0; leg < scorers_.size(); ++leg) {
      const LegPhase phase = robot.motion_state().legs[leg].phase;
      if (phase == LegPhase::kSwing && last_[leg] != LegPhase::kSwing) scorers_[leg].begin_step();
      last_[leg] = phase;
      scorers_[leg].add(robot.joint_state(), robot.truth());
    }
  }
  std::vector<ContactStep> finish() {
    std::vector<ContactStep> steps;
    for (ContactScorer& scorer : scorers_) append(steps, scorer.finish());
    return steps;
  }

 private:
  std::vector<ContactScorer> scorers_;
  std::vector<LegPhase> last_;
};

}  // namespace

std::vector<ContactStep> jump_contacts(const RobotConfig& robot, const std::string& preset,
                                       const SimOptions& sim) {
  std::vector<ContactStep> steps;
  for (const JumpMode mode : {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid}) {
    ContactScorer scorer(kSteppingLeg);
    MotionPhase last = MotionPhase::kIdle;
    run_in_process(
        jump_script(robot, preset, sim, mode, 1),
        [&](const CycleRecord& cycle) {
          if (cycle.motion_state.state == MotionPhase::kThrust && last != MotionPhase::kThrust)
            scorer.begin_step();
          last = cycle.motion_state.state;
          scorer.add(cycle.joint_state, cycle.truth);
        },
        [](const OperatorReply&) {});
    append(steps, scorer.finish());
  }
  return steps;
}

void run_stepping(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int steps,
                  const SteppingObserver& on_cycle) {
  SteppingScript script;
  script.seed = sim.seed;
  script.steps = steps;
  SimOptions suspended = sim;
  suspended.plant["suspended"] = script.hip_height_m + robot.legs.front().foot_radius_m;
  SteppingLeg stepping(script);
  InProcessRobot process(robot, preset, suspended);
  process.command_legs_by([&](const JointState& in, LegCommand& out) { stepping.command(in, out); });
  process.boot();
  const auto most_cycles = static_cast<std::int64_t>(kLongestStep_s * (steps + 1) / robot.cycle_s);
  while (!stepping.done()) {
    process.tick();
    if (stepping.step_begins()) move_floor(process, stepping.floor_height_m());
    on_cycle(process.joint_state(), process.truth(), stepping.step_begins());
    if (process.sim().failed()) throw std::runtime_error(process.sim().failure());
    if (process.cycle() > most_cycles) throw std::runtime_error("the suspended leg does not step");
  }
}

std::vector<ContactStep> stepping_contacts(const RobotConfig& robot, const std::string& preset,
                                           const SimOptions& sim, int steps) {
  ContactScorer scorer(kSteppingLeg);
  run_stepping(robot, preset, sim, steps, [&](const JointState& in, const SimTruth& truth, bool step_begins) {
    if (step_begins) scorer.begin_step();
    scorer.add(in, truth);
  });
  return scorer.finish();
}

std::vector<ContactStep> run_contacts(const RobotConfig& robot, const ContactRequest& request) {
  std::vector<ContactStep> steps;
  std::size_t ground = 0;
  for (SimOptions sim : request.plants) {
    sim.plant.emplace("ground_stiffness", kGrounds_N_m[ground++ % std::size(kGrounds_N_m)]);
    sim.plant.emplace("sync_jitter_us", kJitter_us);
    if (request.jumps) append(steps, jump_contacts(robot, request.preset, sim));
    append(steps, stepping_contacts(robot, request.preset, sim, request.steps_per_plant));
  }
  return steps;
}

std::vector<ReportRow> contact_rows(const std::vector<ContactStep>& steps) {
  const Counts counts = count(steps);
  std::vector<ReportRow> rows{row("estimator.contact.found", "%", percent(counts.found, counts.touchdowns),
                                  at_least(kLeastFound_percent))};
  for (const auto& [approach, most_ms] : kDelays) {
    std::vector<double> delays_ms;
    for (const ContactStep& step : steps) {
      if (step.delay_ms && approach_class(*step.approach_speed_m_s) == approach)
        delays_ms.push_back(*step.delay_ms);
    }
    rows.push_back(row(std::string("estimator.contact.delay_median_") + name(approach), "ms",
                       median_of(delays_ms), at_most(most_ms)));
  }
  rows.push_back(row("estimator.contact.false_alarms", "%", percent(counts.false_alarms, steps.size()),
                     at_most(kMostFalseAlarms_percent)));
  return rows;
}

std::vector<ContactStep> walking_contacts(const RobotConfig& robot, const WalkingContactRequest& request) {
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = gait_index(robot, request.gait);
  walk.walk_speed = {request.forward_m_s, 0.0, 0.0};
  LeggedTrial trial(robot, request.preset, lying(request.sim));
  trial.stand_up();
  trial.say(walk);
  WalkScorer scorer(robot.legs.size());
  trial.run(request.walking_s, [&](InProcessRobot& process) { scorer.add(process); });
  if (trial.robot().motion_state().state != MotionPhase::kWalking)
    throw std::runtime_error("the robot does not walk to the end");
  return scorer.finish();
}

std::vector<ReportRow> walking_contact_rows(const std::string& gait, const std::vector<ContactStep>& steps) {
  const Counts counts = count(steps);
  std::vector<double> delays_ms;
  for (const ContactStep& step : steps) {
    if (step.delay_ms) delays_ms.push_back(*step.delay_ms);
  }
  const std::string prefix = "estimator.contact." + gait;
  return {
      row(prefix + ".found", "%", percent(counts.found, counts.touchdowns), at_least(kLeastFound_percent)),
      row(prefix + ".delay_median", "ms", median_of(delays_ms), at_most(kWalkingDelay_ms)),
      row(prefix + ".delay_p95", "ms", quantile(delays_ms, 0.95), at_most(kWalkingDelay_ms)),
      row(prefix + ".false_alarms", "%", percent(counts.false_alarms, steps.size()),
          at_most(kMostFalseAlarms_percent))};
}

}  // namespace sprung
