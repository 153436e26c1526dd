#include "tools/lab/estimation/contact_experiment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "signals/quantile.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/estimation/stepping_leg.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

namespace {

constexpr std::size_t kSteppingLeg = 0;
constexpr double kGrounds_N_m[] = {8000.0, 15000.0, 30000.0, 60000.0};
constexpr double kJitter_us = 2.0;
constexpr double kLongestStep_s = 9.0;  // at 0.08 m/s, with its waits

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

double median_of(std::vector<double> values) { return quantile(std::move(values), 0.5); }

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
  const ContactCounts counts(steps);
  std::vector<ReportRow> rows{
      row("estimator.contact.found", "%", counts.found_percent(), at_least(kLeastContactFound_percent))};
  for (const auto& [approach, most_ms] : kDelays) {
    std::vector<double> delays_ms;
    for (const ContactStep& step : steps) {
      if (step.delay_ms && approach_class(*step.approach_speed_m_s) == approach)
        delays_ms.push_back(*step.delay_ms);
    }
    rows.push_back(row(std::string("estimator.contact.delay_median_") + name(approach), "ms",
                       median_of(delays_ms), at_most(most_ms)));
  }
  rows.push_back(row("estimator.contact.false_alarms", "%", counts.false_alarms_percent(),
                     at_most(kMostContactFalseAlarms_percent)));
  return rows;
}

}  // namespace sprung
