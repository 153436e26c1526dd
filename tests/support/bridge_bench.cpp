#include "tests/support/bridge_bench.h"

namespace sprung::test {

RobotConfig two_drive_robot() {
  RobotConfig robot;
  robot.name = "two_drives";
  robot.cycle_s = 0.001;
  robot.buses = {{"leg", "memory:leg"}};
  for (const int node : {1, 2}) {
    ActuatorConfig actuator;
    actuator.name = node == 1 ? "hip_motor" : "knee_motor";
    actuator.node = node;
    actuator.profile = "gold";
    actuator.identity = {0x9A, 0x00030923, 0, 0};
    actuator.gear_ratio = 100;
    actuator.direction = node == 1 ? 1.0 : -1.0;
    actuator.torque_constant_Nm_A = 0.044;
    actuator.rated_current_A = 7.0;
    actuator.encoder_counts_per_turn = 131072;
    actuator.offset_rad = 0.1;
    actuator.referenced = true;
    actuator.torque_limit_Nm = 171.6;
    actuator.speed_limit_rad_s = 12;
    actuator.speed_limit_object = 0x6080;
    actuator.position_stiffness_Nm_rad = 503;
    actuator.position_damping_Nm_s_rad = 29.7;
    actuator.safety_damping_Nm_s_rad = 12;
    robot.actuators.push_back(actuator);
  }
  return robot;
}

RobotConfig with_leg(RobotConfig robot, double limit_rad) {
  const std::size_t size = robot.actuators.size();
  LegConfig leg;
  leg.name = "leg";
  leg.kinematics = kNoKinematics;
  leg.transmission.assign(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    JointConfig joint;
    joint.name = "joint" + std::to_string(i);
    joint.position_min_rad = -limit_rad;
    joint.position_max_rad = limit_rad;
    robot.joints.push_back(joint);
    leg.joints.push_back(static_cast<int>(i));
    leg.actuators.push_back(static_cast<int>(i));
    leg.transmission[i * size + i] = 1.0;
  }
  robot.legs.push_back(leg);
  return robot;
}

RobotConfig robot_with_card() {
  RobotConfig robot = two_drive_robot();
  robot.encoder_cards = {{"leg_card", 0, 9, "encoder_card", {0x1, 0x2, 0, 0}}};
  for (int i = 0; i < 2; ++i) {
    ActuatorConfig& actuator = robot.actuators[i];
    actuator.link_encoder = {0, i, 1048576.0, i == 0 ? -1.0 : 1.0, 0.1};
  }
  return robot;
}

BridgeBench::BridgeBench(const RobotConfig& config)
    : robot(config),
      bridge(std::make_unique<BridgeCore>(config, BridgeOptions{config.watchdogs})),
      command(config.actuators.size()),
      state(config.actuators.size()) {
  for (const ActuatorConfig& actuator : robot.actuators)
    drives.emplace_back(actuator.node, actuator.identity);
  for (const EncoderCardConfig& card : robot.encoder_cards) cards.emplace_back(card.node, card.identity);
  command_all(DriveMode::kDisabled);
}

void BridgeBench::deliver(const FrameBatch& batch) {
  answers_.clear();
  for (const BusFrame& item : batch) {
    for (FakeDrive& drive : drives) drive.receive(item.frame, answers_);
    for (FakeCard& card : cards) card.receive(item.frame, answers_);
  }
  if (on_answers) on_answers(answers_);
  for (const CanFrame& frame : answers_) bridge->receive(0, frame, time_us);
}

void BridgeBench::tick() {
  time_us += 1000;
  last_begin.clear();
  bridge->begin_tick(time_us, last_begin);
  deliver(last_begin);
  answers_.clear();
  for (FakeDrive& drive : drives) drive.tick(time_us, answers_);
  for (FakeCard& card : cards) card.tick(time_us, answers_);
  if (on_answers) on_answers(answers_);
  for (const CanFrame& frame : answers_) bridge->receive(0, frame, time_us);
  in_cycle = bridge->end_sampling(time_us, state);
  if (in_cycle && !mute_commands) {
    command.stamp = state.stamp;
    command.valid_until_utime_us = time_us + 21000;  // as the controller: command_hold and a cycle
    last_command_accepted = bridge->command(command, time_us);
  }
  last_setpoints.clear();
  bridge->emit_setpoints(time_us, last_setpoints);
  deliver(last_setpoints);
}

void BridgeBench::run(int ticks) {
  for (int i = 0; i < ticks; ++i) tick();
}

bool BridgeBench::boot(int ticks) {
  for (int i = 0; i < ticks && !bridge->operational(); ++i) tick();
  return bridge->operational();
}

void BridgeBench::enable(DriveMode mode) {
  command_all(DriveMode::kDisabled);
  run(3);
  command_all(mode, 0.0, state.actuators[0].measured_position_rad);
  run(20);
}

OperatorReply BridgeBench::ask(OperatorKind kind) {
  OperatorCommand request;
  request.kind = kind;
  request.request_id = next_request++;
  return bridge->operator_command(request, time_us);
}

OperatorReply BridgeBench::ask_and_wait(OperatorKind kind, int ticks) {
  OperatorReply reply = ask(kind);
  for (int i = 0; i < ticks && reply.outcome == OperatorOutcome::kAccepted; ++i) {
    tick();
    bridge->next_reply(reply);
  }
  return reply;
}

void BridgeBench::command_all(DriveMode mode, double torque_Nm, double position_rad) {
  for (ActuatorCommand& actuator : command.actuators) {
    actuator.mode = mode;
    actuator.commanded_torque_Nm = torque_Nm;
    actuator.commanded_position_rad = position_rad;
  }
}

std::vector<CanFrame> BridgeBench::sent(std::uint32_t id) const {
  std::vector<CanFrame> frames;
  for (const FrameBatch* batch : {&last_begin, &last_setpoints}) {
    for (const BusFrame& item : *batch) {
      if (item.frame.id == id) frames.push_back(item.frame);
    }
  }
  return frames;
}

int BridgeBench::enabled() const {
  return static_cast<int>(std::count_if(drives.begin(), drives.end(), [](const FakeDrive& drive) {
    return drive.power == PowerState::kOperationEnabled;
  }));
}

}  // namespace sprung::test
