#include "tools/lab/run/scripted_run.h"

#include <stdexcept>

namespace sprung {

OperatorCommand scripted(OperatorKind kind, std::int64_t at_seq) {
  OperatorCommand command;
  command.kind = kind;
  command.apply_at_seq = at_seq;
  command.request_id = at_seq + 1;
  return command;
}

void throw_unless_obeyed(const OperatorReply& reply) {
  if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed)
    throw std::runtime_error(std::string("the robot ") + name(reply.outcome) + " a command: " + reply.reason);
}

void run_in_process(const RunScript& script, const CycleObserver& on_cycle, const ReplyObserver& on_reply) {
  InProcessRobot robot(script.robot, script.preset, script.sim);
  for (const OperatorCommand& command : script.commands) {
    robot.submit(command);
  }
  for (const SimControl& control : script.controls) robot.sim().control(control);
  if (script.command_legs_by) robot.command_legs_by(script.command_legs_by);
  robot.boot();
  for (bool first = true; robot.cycle() < script.cycles - 1 || first; first = false) {
    if (!first) {
      robot.tick();
    }
    on_cycle({robot.drive_state(), robot.joint_state(), robot.motion_state(), robot.drive_command(),
              robot.truth(), robot.leg_command()});
    for (OperatorReply reply; robot.next_reply(reply);) {
      on_reply(reply);
    }
    if (robot.sim().failed()) {
      throw std::runtime_error(std::string("the simulated plant failed: ") + robot.sim().failure());
    }
  }
}

}  // namespace sprung
