#include "tools/operate/commands/answers.h"

#include <unistd.h>

#include <cstdio>

#include "runtime/command_line.h"
#include "runtime/stop_request.h"

namespace sprung::commands {

bool confirmed(const std::string& question, bool yes) {
  if (yes) return true;
  if (isatty(STDIN_FILENO) == 0) throw WrongUse(question + " Nobody to ask here: add --yes");
  std::printf("%s [y/N] ", question.c_str());
  std::fflush(stdout);
  char answer[16] = "";
  if (std::fgets(answer, sizeof answer, stdin) == nullptr) return false;
  return answer[0] == 'y' || answer[0] == 'Y';
}

bool report_answer(const char* what, const std::optional<OperatorAnswer>& answer) {
  if (!answer) {
    std::fprintf(
        stderr,
        "%s: the drive bridge does not answer. PRESS THE HARDWARE EMERGENCY STOP; then: sprung down\n", what);
    return false;
  }
  const bool bad = answer->outcome == OperatorOutcome::kRefused ||
                   answer->outcome == OperatorOutcome::kFailed;
  std::fprintf(bad ? stderr : stdout, "%s: %s%s%s\n", what, name(answer->outcome),
               answer->reason.empty() ? "" : ": ", answer->reason.c_str());
  return !bad;
}

bool report_motion(const char* what, const std::optional<OperatorAnswer>& answer) {
  if (!answer) {
    std::fprintf(stderr, "%s: %s\n", what,
                 stop_requested() ? "not waited for; the robot goes on. To end it: sprung stop"
                                  : "no answer from the motion planner. See: sprung status");
    return false;
  }
  const bool bad = answer->outcome == OperatorOutcome::kRefused ||
                   answer->outcome == OperatorOutcome::kFailed;
  std::fprintf(bad ? stderr : stdout, "%s: %s%s%s", what, name(answer->outcome),
               answer->reason.empty() ? "" : ": ", answer->reason.c_str());
  std::fprintf(bad ? stderr : stdout, answer->took_effect_at_seq >= 0 ? " (cycle %lld)\n" : "\n",
               static_cast<long long>(answer->took_effect_at_seq));
  std::fflush(stdout);
  return !bad;
}

}  // namespace sprung::commands
