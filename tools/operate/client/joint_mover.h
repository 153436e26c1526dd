#pragma once
/// An operator's hand on single joints of a running robot: watches JOINT_STATE, orders moves and follows them
/// to their end.
#include <functional>
#include <optional>
#include <string>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "signals/joint_state.h"
#include "signals/operator.h"
#include "tools/operate/client/operator_client.h"

namespace sprung {

/// @throws std::invalid_argument naming the joints there are.
int joint_named(const RobotConfig& robot, const std::string& name);

/// A move whose speed and acceleration are still to be set: a tenth of the joint's speed limit, reached in a
/// quarter of a second.
OperatorCommand gentle_move(const RobotConfig& robot, int joint, double target_rad);

class JointMover {
 public:
  using Progress = std::function<void(const JointState&)>;

  JointMover(const RunInfo& info, const RobotConfig& robot);

  /// Takes what has come in, waiting for the next JOINT_STATE where nothing has. @return the newest; nullptr
  /// when none came within `timeout_s` of wall time, or on a stop request.
  const JointState* look(double timeout_s);

  /// As OperatorClient::send.
  std::optional<OperatorAnswer> send(OperatorCommand& command);
  /// Until it is done, has failed or was refused. nullopt on a stop request, or when nothing comes from the
  /// robot any more.
  /// @param progress sees every JOINT_STATE on which it looks; may be empty.
  std::optional<OperatorAnswer> follow(const OperatorCommand& command, const Progress& progress);
  /// Both; the answer is the last one.
  std::optional<OperatorAnswer> carry_out(OperatorCommand& command, const Progress& progress = {});

  /// Seconds of the robot's own time. @return false on a stop request, when safety is lost, or nothing comes
  /// any more.
  bool pause(double seconds);

 private:
  InputQueue<JointState> states_{1 << 14};
  std::optional<JointState> newest_;
  Node node_;
  OperatorClient client_;
};

}  // namespace sprung
