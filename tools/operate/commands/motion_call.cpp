#include "tools/operate/commands/motion_call.h"

#include "tools/operate/commands/answers.h"

namespace sprung::commands {

void add_motion_call(CommandLine& command, MotionCall& call) {
  command.option("--instance", call.instance, "which run");
  command.option("--robot", call.robot, "refuse unless this robot is up");
  command.option("--at", call.at_seq, "cycle in which it shall take effect, -1 = the next");
  command.flag("--no-wait", call.no_wait, "return when it is accepted, not when it is done");
}

int motion_exit(const char* what, const std::optional<OperatorAnswer>& answer) {
  return report_motion(what, answer) ? kExitDone : kExitFailed;
}

int run_motion(const char* what, OperatorCommand command, const MotionCall& call) {
  OperatorClient client(require_running(call.instance, call.robot));
  command.apply_at_seq = call.at_seq;
  const std::optional<OperatorAnswer> answer = client.send(command, kAnswer_s);
  const int status = motion_exit(what, answer);
  const bool under_way = answer && status == kExitDone && answer->outcome != OperatorOutcome::kDone;
  if (!under_way || call.no_wait) {
    return status;
  }
  return motion_exit(what, client.wait_done(command, kSilence_s));
}

}  // namespace sprung::commands
