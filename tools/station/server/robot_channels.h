#pragma once
/// What a station shows of a robot: channels, types of their messages, and how long those are. Pure.
#include "lcmtypes/channels.h"
#include "robots/robot_config.h"
#include "runtime/message_layout.h"
#include "signals/messages.h"

namespace sprung::station {

template <class M>
struct RobotChannel {
  using Message = M;
  const char* name;
  CountLimits limits;
};

/// Calls `visit` with a RobotChannel for each.
template <class Visit>
void visit_robot_channels(const RobotConfig& robot, Visit visit) {
  using namespace sprung_msgs;
  const std::size_t actuators = robot.actuators.size(), joints = robot.joints.size(),
                    legs = robot.legs.size(), nodes = actuators + robot.encoder_cards.size();
  visit(RobotChannel<drive_state_t>{channels::kDriveState, CountLimits::exactly(actuators)});
  visit(RobotChannel<drive_command_t>{channels::kDriveCommand, CountLimits::exactly(actuators)});
  visit(RobotChannel<joint_state_t>{channels::kJointState, CountLimits::exactly(joints, legs)});
  visit(RobotChannel<leg_command_t>{channels::kLegCommand, CountLimits::exactly(legs)});
  visit(RobotChannel<motion_state_t>{channels::kMotionState, CountLimits::exactly(legs)});
  visit(RobotChannel<safety_state_t>{channels::kSafetyState, CountLimits::none()});
  visit(RobotChannel<imu_t>{channels::kImu, CountLimits::none()});
  visit(RobotChannel<body_state_t>{channels::kBodyState, CountLimits::none()});
  visit(RobotChannel<sim_truth_t>{channels::kSimTruth, CountLimits::exactly(joints, legs)});
  visit(RobotChannel<bus_state_t>{channels::kBusState, CountLimits::exactly(robot.buses.size(), nodes)});
  visit(RobotChannel<auxiliary_state_t>{channels::kAuxiliaryState, CountLimits::exactly(actuators)});
}

}  // namespace sprung::station
