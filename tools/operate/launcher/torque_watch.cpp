#include "tools/operate/launcher/torque_watch.h"

#include <algorithm>

#include "lcmtypes/channels.h"

namespace sprung {
namespace {

bool may_have_torque(PowerState state) noexcept {
  switch (state) {  // CiA 402: the motor is driven in the four states below alone
    case PowerState::kUnknown:
    case PowerState::kOperationEnabled:
    case PowerState::kQuickStopActive:
    case PowerState::kFaultReactionActive:
      return true;
    default:
      return false;
  }
}

}  // namespace

bool may_have_torque(const DriveState& state) noexcept {
  return std::any_of(state.actuators.begin(), state.actuators.end(),
                     [](const ActuatorState& actuator) { return may_have_torque(actuator.power_state); });
}

TorqueWatch::TorqueWatch(const NodeOptions& options, const RobotConfig& robot)
    : states_(DriveState(robot.actuators.size())), node_(options) {
  node_.subscribe(channels::kDriveState, CountLimits::exactly(robot.actuators.size()), states_);
  node_.start();
}

TorqueWatch::~TorqueWatch() { node_.stop(); }

std::optional<TorqueHeard> TorqueWatch::heard() const {
  DriveState state;
  if (!states_.newest(state)) return std::nullopt;
  return TorqueHeard{may_have_torque(state), state.stamp.utime_us};
}

}  // namespace sprung
