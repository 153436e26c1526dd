#pragma once
/// Bridge core and fake drives, tick by tick, as a shell would call them. Every tick sends one DRIVE_COMMAND,
/// unless muted.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/bridge/bridge_core.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/operator.h"
#include "tests/support/fake_card.h"
#include "tests/support/fake_drive.h"

namespace sprung::test {

/// Two joints like single_leg's, written here so that tests do not depend on the robot's file.
RobotConfig two_drive_robot();

/// `robot` with one leg of all its actuators, each a joint of its own that may turn by `limit_rad` either
/// way.
RobotConfig with_leg(RobotConfig robot, double limit_rad = 100.0);

/// two_drive_robot() with a card that sees both joints from the link side.
RobotConfig robot_with_card();

class BridgeBench {
 public:
  explicit BridgeBench(const RobotConfig& robot = two_drive_robot());

  void tick();
  void run(int ticks);
  /// @return false when the bridge is not operational after `ticks`.
  bool boot(int ticks = 2000);
  /// Arms with disabled commands, then commands `mode` until the drives are enabled.
  void enable(DriveMode mode = DriveMode::kTorque);
  OperatorReply ask(OperatorKind kind);
  /// Asks, and ticks until the request is done, has failed or was refused; at most `ticks`.
  OperatorReply ask_and_wait(OperatorKind kind, int ticks = 7000);
  /// Sets every actuator's command.
  void command_all(DriveMode mode, double torque_Nm = 0.0, double position_rad = 0.0);

  /// Drives that have power now.
  int enabled() const;
  std::string detail() const { return bridge->safety().detail.data(); }
  /// Frames that the bridge sent in the last tick and are of this identifier.
  std::vector<CanFrame> sent(std::uint32_t id) const;

  RobotConfig robot;
  std::unique_ptr<BridgeCore> bridge;
  std::vector<FakeDrive> drives;
  std::vector<FakeCard> cards;
  /// May change what the nodes answer in a tick, before the bridge gets it.
  std::function<void(std::vector<CanFrame>&)> on_answers;
  DriveCommand command;
  DriveState state;
  FrameBatch last_begin, last_setpoints;
  bool mute_commands = false;
  bool in_cycle = false;  ///< the last tick gave a DRIVE_STATE
  bool last_command_accepted = false;
  std::int64_t time_us = 0;
  std::int64_t next_request = 1;

 private:
  void deliver(const FrameBatch& batch);

  std::vector<CanFrame> answers_;
};

}  // namespace sprung::test
