#pragma once
/// What every motion command has in common: to whom it goes, when, and how it is waited for.
#include <optional>
#include <string>

#include "signals/operator.h"
#include "tools/commands.h"
#include "tools/operate/client/operator_client.h"

namespace sprung::commands {

inline constexpr double kAnswer_s = 3.0;
/// Without any answer from the planner, which is asked twice a second.
inline constexpr double kSilence_s = 5.0;

struct MotionCall {
  std::string instance = "default";
  std::string robot;  ///< empty: whichever is up
  bool no_wait = false;
  std::int64_t at_seq = -1;
};

/// Its options.
void add_motion_call(CommandLine& command, MotionCall& call);

/// Prints what became of it. @return exit status.
int motion_exit(const char* what, const std::optional<OperatorAnswer>& answer);

/// Sends, and waits until it is done unless told not to. @return exit status.
int run_motion(const char* what, OperatorCommand command, const MotionCall& call);

}  // namespace sprung::commands
