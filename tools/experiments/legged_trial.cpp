#include "tools/experiments/legged_trial.h"

#include <cmath>
#include <stdexcept>

#include "tools/experiments/scripted_run.h"

namespace sprung {
namespace {

constexpr double kWake_s = 0.2;    // the estimator has settled
constexpr double kHome_s = 1.0;    // references are taken within a few cycles
constexpr double kEnable_s = 1.0;  // and settling, beside the preset's rise_time

const RobotConfig& walking(const RobotConfig& robot) {
  if (robot.gaits.empty())
    throw std::invalid_argument("this experiment needs a robot that walks; " + robot.name + " has no gaits");
  return robot;
}

}  // namespace

LeggedTrial::LeggedTrial(const RobotConfig& robot, const std::string& preset, const SimOptions& sim)
    : cycle_s_(robot.cycle_s),
      rise_s_(robot.preset(preset).rise_time_s),
      robot_(walking(robot), preset, sim) {
  robot_.boot();
}

void LeggedTrial::stand_up() {
  run(kWake_s);
  OperatorCommand home;
  home.kind = OperatorKind::kHome;
  home.reference_source = ReferenceSource::kLink;
  say(home);
  run(kHome_s);
  OperatorCommand stand;
  stand.kind = OperatorKind::kStand;
  say(stand);
  run(rise_s_ + kEnable_s);
  if (robot_.motion_state().state != MotionPhase::kStanding)
    throw std::runtime_error(std::string("the robot does not stand: ") +
                             robot_.motion_state().last_transition);
  up_ = true;
}

void LeggedTrial::say(OperatorCommand command) {
  command.request_id = ++said_;
  robot_.submit(command);
}

void LeggedTrial::run(double duration_s, const OnCycle& on_cycle) {
  const std::int64_t cycles = std::llround(duration_s / cycle_s_);
  for (std::int64_t i = 0; i < cycles; ++i) {
    robot_.tick();
    for (OperatorReply reply; robot_.next_reply(reply);) throw_unless_obeyed(reply);
    check();
    if (on_cycle) on_cycle(robot_);
  }
}

void LeggedTrial::check() const {
  const MotionState& motion = robot_.motion_state();
  if (up_ && (motion.state == MotionPhase::kIdle || motion.state == MotionPhase::kFallen))
    throw std::runtime_error(std::string("the robot has left its feet: ") + motion.last_transition);
}

SimOptions lying(SimOptions sim) {
  sim.plant["suspended"] = 0.0;
  sim.plant["lying"] = 1.0;
  return sim;
}

int gait_index(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.gaits.size(); ++i)
    if (robot.gaits[i].name == name) return static_cast<int>(i);
  throw std::invalid_argument(robot.name + " has no gait " + name);
}

}  // namespace sprung
