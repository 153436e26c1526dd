#include "tools/lab/identify/drive_log.h"

#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "runtime/receive_guard.h"
#include "signals/messages.h"
#include "tools/can/frame_source.h"

namespace sprung::identify {

namespace {

void require_lcm_log(const std::string& path) {
  if (!is_lcm_log(path))
    throw std::runtime_error(path + " is no LCM log; for a table give --csv and --columns instead of --log");
}

}  // namespace

std::string robot_of_log(const std::string& path) {
  require_lcm_log(path);
  return log_origin(path).robot;
}

DriveLog read_drive_log(const std::string& path, const RobotConfig& robot) {
  require_lcm_log(path);
  lcm::LogFile log(path, "r");
  const CountLimits limits = CountLimits::exactly(static_cast<std::int32_t>(robot.actuators.size()));
  ReceiveGuard guard(channels::kDriveState, layout_of<sprung_msgs::drive_state_t>(), limits, 0);
  sprung_msgs::drive_state_t message;
  DriveState state(robot.actuators.size());
  DriveLog out;
  std::int64_t session = 0, strangers = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (event->channel != channels::kDriveState) continue;
    if (guard.decode(event->data, static_cast<std::size_t>(event->datalen), message) != Refusal::kNone ||
        !from_message(message, state))
      continue;
    if (session == 0) session = message.session;
    if (message.session != session) {
      ++strangers;
      continue;
    }
    out.states.push_back(state);
  }
  if (out.states.empty())
    throw std::runtime_error(path + " holds no DRIVE_STATE of " + robot.name +
                             (guard.refused() > 0 ? ": " + guard.last_refusal() : "") +
                             "; is it another robot's (--robot)?");
  if (guard.refused() > 0)
    out.notes.push_back(std::to_string(guard.refused()) +
                        " damaged messages left out: " + guard.last_refusal());
  if (strangers > 0) out.notes.push_back(std::to_string(strangers) + " messages of later sessions left out");
  return out;
}

}  // namespace sprung::identify
