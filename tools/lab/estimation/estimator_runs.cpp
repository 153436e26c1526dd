#include "tools/lab/estimation/estimator_runs.h"

#include <stdexcept>

#include "tools/lab/jump/jump_experiment.h"

namespace sprung {
namespace {

using Part = JumpWindow::Part;

void add_cycle(Part part, const JointState& estimated, const SimTruth& truth, JumpScores& scores) {
  for (std::size_t j = 0; j < truth.joints.size(); ++j) {
    const auto add_to = [&](std::vector<TorqueScore>& sums) {
      sums[j].add(estimated.joints[j], truth.joints[j]);
    };
    if (part == Part::kPushOff) add_to(scores.push_off);
    if (part == Part::kLanding) add_to(scores.landing);
    if (part != Part::kOther) add_to(scores.jump);
    if (part == Part::kOther && estimated.joints[j].at_rest) add_to(scores.rest);
  }
}

void add_each(std::vector<TorqueScore>& sums, const std::vector<TorqueScore>& others) {
  for (std::size_t j = 0; j < sums.size(); ++j) sums[j].add(others[j]);
}

}  // namespace

void JumpScores::add(const JumpScores& other) {
  add_each(push_off, other.push_off);
  add_each(landing, other.landing);
  add_each(jump, other.jump);
  add_each(rest, other.rest);
}

JumpScores score_jump(const RobotConfig& robot, const std::string& preset, const SimOptions& sim) {
  JumpScores scores(robot.joints.size());
  JumpWindow window;
  run_in_process(
      jump_script(robot, preset, sim, JumpMode::kHybrid, 1),
      [&](const CycleRecord& cycle) {
        add_cycle(window.add(cycle.motion_state, cycle.truth), cycle.joint_state, cycle.truth, scores);
      },
      [](const OperatorReply&) {});
  if (!window.complete()) throw std::runtime_error("the robot did not jump and land");
  return scores;
}

std::size_t joint_index(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
  }
  throw std::invalid_argument("robot " + robot.name + " has no joint '" + name +
                              "', which this experiment measures");
}

}  // namespace sprung
