#include <cstdio>
#include <memory>

#include "tools/client/operator_client.h"
#include "tools/commands/commands.h"

namespace sprung::commands {

namespace {

constexpr double kAnswer_s = 3.0;

int run_safety(const char* what, OperatorKind kind, const std::string& instance) {
  OperatorClient client(require_running(instance, ""));
  OperatorCommand command;
  command.kind = kind;
  const std::optional<OperatorAnswer> answer = client.send(command, kAnswer_s);
  if (!answer) {
    std::fprintf(
        stderr,
        "%s: the drive bridge does not answer. PRESS THE HARDWARE EMERGENCY STOP; then: sprung down\n", what);
    return kExitFailed;
  }
  const bool bad =
      answer->outcome == OperatorOutcome::kRefused || answer->outcome == OperatorOutcome::kFailed;
  std::fprintf(bad ? stderr : stdout, "%s: %s: %s\n", what, name(answer->outcome), answer->reason.c_str());
  return bad ? kExitFailed : kExitDone;
}

void add(CommandLine& sprung, const char* what, const char* help, OperatorKind kind) {
  const auto instance = std::make_shared<std::string>("default");
  CommandLine& command = sprung.subcommand(what, help);
  command.option("--instance", *instance, "which run");
  command.example(std::string("sprung ") + what);
  command.action([=] { return run_safety(what, kind, *instance); });
}

}  // namespace

void add_safety(CommandLine& sprung) {
  add(sprung, "estop", "Switch every drive off at once; stays so until `sprung clear`.",
      OperatorKind::kEstop);
  add(sprung, "clear", "Forget a latched cause whose reason is gone; torque stays off until `sprung stand`.",
      OperatorKind::kClear);
}

}  // namespace sprung::commands
