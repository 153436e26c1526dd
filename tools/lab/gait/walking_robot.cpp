#include "tools/lab/gait/walking_robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "robots/gait_speed.h"

namespace sprung {

WalkingRobot::WalkingRobot(const RobotConfig& robot, const std::string& preset, const SimOptions& sim)
    : config_(robot), trial_(robot, preset, sim), vitals_(robot), reserve_(robot, sim) {
  trial_.stand_up();
}

void WalkingRobot::walk(const std::string& gait, const Vec3& speed, GaitControl control) {
  OperatorCommand command;
  command.kind = OperatorKind::kWalk;
  command.gait = gait_index(config_, gait);
  command.walk_speed = speed;
  command.gait_control = control;
  must_walk_ = true;
  say(command);
}

void WalkingRobot::push(const std::array<double, 2>& impulse_Ns, double duration_s) {
  SimControl wrench;
  wrench.kind = SimControlKind::kWrench;
  wrench.wrench = {impulse_Ns[0] / duration_s, impulse_Ns[1] / duration_s, 0.0, 0.0, 0.0, 0.0};
  wrench.duration_s = duration_s;
  robot().sim().control(wrench);
}

void WalkingRobot::run(double duration_s, const OnCycle& on_cycle) {
  const std::int64_t cycles = std::llround(duration_s / config_.cycle_s);
  InProcessRobot& r = robot();
  for (std::int64_t i = 0; i < cycles; ++i) {
    r.tick();
    for (OperatorReply reply; r.next_reply(reply);) {
      if (reply.outcome != OperatorOutcome::kRefused) continue;
      ++refusals_;
      last_refusal_ = reply.reason;
      if (must_walk_) throw std::runtime_error("the robot refuses to walk: " + last_refusal_);
    }
    if (r.sim().failed()) throw std::runtime_error(std::string("simulation: ") + r.sim().failure());
    vitals_.add({r.drive_state(), r.joint_state(), r.motion_state(), r.bridge().safety(), r.truth()});
    if (upright()) reserve_.add(r.sim());
    if (on_cycle) on_cycle(r);
  }
}

double speed_reached_s(const RobotConfig& robot, const std::string& preset, const std::string& gait,
                       const Vec3& speed) {
  constexpr double kSettling_s = 2.0;
  const WalkConfig& walk = robot.preset(preset).walk;
  const std::array<double, 3> of_preset{walk.acceleration_m_s2, walk.acceleration_m_s2,
                                        walk.turning_acceleration_rad_s2};
  const std::array<double, 3> of_gait = starting_acceleration(robot.gaits[gait_index(robot, gait)]);
  double longest_s = 0.0;
  for (std::size_t i = 0; i < speed.size(); ++i)
    if (speed[i] != 0.0)
      longest_s = std::max(longest_s, std::abs(speed[i]) / std::min(of_preset[i], of_gait[i]));
  return longest_s + kSettling_s;
}

std::vector<GaitConfig> going_gaits(const RobotConfig& robot, const std::string& asked) {
  std::vector<GaitConfig> out;
  for (const GaitConfig& gait : robot.gaits)
    if (gait.fastest_forward_m_s > 0.0) out.push_back(gait);
  if (asked.empty()) return out;
  const GaitConfig& one = robot.gaits[static_cast<std::size_t>(gait_index(robot, asked))];
  if (!(one.fastest_forward_m_s > 0.0)) throw std::invalid_argument("gait " + asked + " goes nowhere");
  return {one};
}

Experiment gait_experiment(const std::string& name, const std::string& what, const std::string& question) {
  Experiment out;
  out.name = name;
  out.what = what;
  out.question = question;
  out.robot = "pegasus";
  out.takes = {Common::kPreset, Common::kJobs, Common::kPlant, Common::kOut};
  out.seed_help = "of every noise and draw; 0 was used for tuning";
  out.example = "--robot pegasus --seed 1 --out report";
  out.in_all = {RobotKind::kWalker};
  out.many_cases = true;
  out.needs_gaits = true;
  return out;
}

}  // namespace sprung
