#pragma once
/// Motions that go on until told otherwise, walking and complying: somebody must be there, or say beforehand
/// how long. Without --for the command stays in the foreground and renews a hold; Ctrl-C, or a connection
/// that is cut, ends in a stand (design section 8, "operator link lost").
#include <optional>

#include "tools/operate/client/operator_client.h"
#include "tools/operate/commands/motion_call.h"

namespace sprung::commands {

/// Says it ten times a second, answered or not, each time for half a second, until a signal comes, it is
/// refused, or nobody answers. @param kind kHold or kEnable. @return the last answer; what stop_requested()
/// says is why it ended.
std::optional<OperatorAnswer> keep_saying(OperatorKind kind, OperatorClient& client);

struct HeldCall : MotionCall {
  double for_s = kNaN;
};

/// The options of every motion command, and --for.
void add_held_call(CommandLine& command, HeldCall& call);

/// Sends; then returns (--for), or stays until Ctrl-C, a stop of somebody else's, or the motion's own end. In
/// lock-step, where a second of the robot's is not ours, it returns and the motion lasts until told.
/// @return exit status. @throws WrongUse on a time that cannot be.
int run_held(const char* what, OperatorCommand command, const HeldCall& call);

}  // namespace sprung::commands
