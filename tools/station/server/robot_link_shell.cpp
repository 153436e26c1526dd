#include "tools/station/server/robot_link_shell.h"

#include "lcmtypes/channels.h"

namespace sprung::station {

RobotLink::RobotLink(const RunInfo& info, const RobotConfig& robot)
    : session_(info.session),
      drives_(DriveState(robot.actuators.size())),
      joints_(JointState(robot.joints.size(), robot.legs.size())),
      newest_joints_(robot.joints.size(), robot.legs.size()),
      node_(commanding(info)),
      commands_(node_.publisher<OperatorCommand>(channels::kOperatorCommand)) {
  const std::size_t nodes = robot.actuators.size() + robot.encoder_cards.size();
  node_.subscribe(channels::kDriveState, CountLimits::exactly(robot.actuators.size()), drives_);
  node_.subscribe(channels::kJointState, CountLimits::exactly(robot.joints.size(), robot.legs.size()),
                  joints_);
  node_.on_message<sprung_msgs::motion_state_t>(channels::kMotionState,
                                                CountLimits::exactly(robot.legs.size()),
                                                [this](const auto& message) { motions_.put(message); });
  node_.on_message<sprung_msgs::safety_state_t>(channels::kSafetyState, CountLimits::none(),
                                                [this](const auto& message) { safeties_.put(message); });
  node_.on_message<sprung_msgs::bus_state_t>(channels::kBusState,
                                             CountLimits::exactly(robot.buses.size(), nodes),
                                             [this](const auto& message) { buses_.put(message); });
  node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), processes_);
  node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
  node_.start();
}

void RobotLink::say(OperatorCommand command) {
  command.stamp.utime_us = node_.utime_us();
  commands_.publish(command);
}

std::vector<RobotAnswer> RobotLink::take_answers() {
  std::vector<RobotAnswer> out;
  while (const auto reply = replies_.pop())
    out.push_back({reply->request_id, static_cast<OperatorOutcome>(reply->outcome), reply->reason,
                   reply->answered_by, reply->took_effect_at_seq});
  return out;
}

const HeardRobot& RobotLink::hear() {
  const std::int64_t now_us = node_.utime_us();
  while (auto status = processes_.pop()) heard_.processes[status->process] = *status;
  motions_.take_to(heard_.motion, now_us);
  safeties_.take_to(heard_.safety, now_us);
  buses_.take_to(heard_.buses, now_us);
  const std::int64_t before = newest_joints_.stamp.seq;
  if (joints_.newest(newest_joints_) && newest_joints_.stamp.seq != before) {
    sprung_msgs::joint_state_t message;
    to_message(newest_joints_, session_, message);
    heard_.joints.take(std::move(message), now_us);
  }
  heard_.now_us = now_us;
  return heard_;
}

}  // namespace sprung::station
