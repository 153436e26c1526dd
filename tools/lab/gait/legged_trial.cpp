#include "tools/lab/gait/legged_trial.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tools/lab/run/scripted_run.h"

namespace sprung {
namespace {

constexpr double kWake_s = 0.2;           // the estimator has settled
constexpr double kRest_s = 0.05;          // of all joints, so that a turning point is none
constexpr double kLongestSwing_s = 20.0;  // that legs swing after the robot was switched on
/// Half of the speed at which the bridge refuses to home.
constexpr double kRest_rad_s = 0.025;
constexpr double kHome_s = 1.0;    // references are taken within a few cycles
constexpr double kEnable_s = 1.0;  // and settling, beside the preset's rise_time

const RobotConfig& walking(const RobotConfig& robot) {
  if (robot.gaits.empty())
    throw std::invalid_argument("this experiment needs a robot that walks; " + robot.name + " has no gaits");
  return robot;
}

/// The joint that moves fastest, as measured.
struct Fastest {
  std::size_t joint = 0;
  double speed_rad_s = 0.0;
};

Fastest fastest(const JointState& state) {
  Fastest out;
  for (std::size_t i = 0; i < state.joints.size(); ++i) {
    const double speed_rad_s = std::abs(state.joints[i].estimated_velocity_rad_s);
    if (!(speed_rad_s <= out.speed_rad_s)) out = {i, speed_rad_s};
  }
  return out;
}

std::string restless(const RobotConfig& robot, const Fastest& now) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "the robot does not come to rest: after %.0f s joint %s still moves at %.3g rad/s, so it cannot home; "
      "sim.yaml's friction is small, or `lying` is no pose that it can lie in",
      kLongestSwing_s, robot.joints[now.joint].name.c_str(), now.speed_rad_s);
  return text;
}

}  // namespace

LeggedTrial::LeggedTrial(const RobotConfig& robot, const std::string& preset, const SimOptions& sim)
    : config_(robot),
      cycle_s_(robot.cycle_s),
      rise_s_(robot.preset(preset).rise_time_s),
      robot_(walking(robot), preset, sim) {
  robot_.boot();
}

void LeggedTrial::wait_for_rest() {
  double rested_s = 0.0;
  Fastest now;
  const OnCycle watch = [&](InProcessRobot& robot) {
    now = fastest(robot.joint_state());
    rested_s = now.speed_rad_s <= kRest_rad_s ? rested_s + cycle_s_ : 0.0;
  };
  run(kWake_s, watch);
  for (double waited_s = kWake_s; rested_s < kRest_s; waited_s += cycle_s_) {
    if (waited_s > kLongestSwing_s) throw std::runtime_error(restless(config_, now));
    run(cycle_s_, watch);
  }
}

void LeggedTrial::stand_up() {
  wait_for_rest();
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
  if (!up_ || (motion.state != MotionPhase::kIdle && motion.state != MotionPhase::kFallen)) return;
  const SafetyState& safety = robot_.bridge().safety();
  std::string why = motion.last_transition;
  if (safety.cause != SafetyCause::kNone)
    why += std::string(" (") + name(safety.cause) + ": " + safety.detail.data() + ")";
  throw std::runtime_error("the robot has left its feet: " + why);
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
