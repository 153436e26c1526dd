/// Any OPERATOR_COMMAND, at any moment, to the planner of a robot whose feet go where they are told to.
#include <cmath>

#include "planner/planner_core.h"
#include "robots/robot_loader.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "tests/fuzz/any_signal.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/paths.h"

namespace sprung::fuzz::planner_requests {
namespace {

const std::vector<RobotConfig>& robots() {
  static const std::vector<RobotConfig> all{load_robot(test::source_dir() + "/robots/single_leg"),
                                            load_robot(test::source_dir() + "/robots/pegasus")};
  return all;
}

class Bench {
 public:
  explicit Bench(const RobotConfig& robot, const PresetConfig& preset)
      : robot_(robot),
        stand_m_(preset.stand_length_m),
        planner_(robot, preset),
        state_(robot.joints.size(), robot.legs.size()),
        legs_(robot.legs.size()),
        motion_(robot.legs.size()) {
    state_.safety = SafetyLevel::kOperational;
    state_.body.estimated_quaternion_wxyz = {1, 0, 0, 0};
    state_.body.estimated_height_m = stand_m_;
    state_.body.uses_imu = true;
    for (EstimatedJoint& joint : state_.joints) {
      joint.status = JointStatus::kOk;
      joint.drive_enabled = true;
      joint.estimated_position_rad = 0.0;
      joint.estimated_velocity_rad_s = 0.0;
    }
    for (EstimatedLeg& leg : state_.legs) {
      leg.estimated_foot_in_hip_m = {0.0, 0.0, -0.9 * stand_m_};
      leg.contact = true;
    }
  }
  void submit(Input& input) {
    OperatorCommand command;
    command.request_id = ++last_id_;
    command.kind = static_cast<OperatorKind>(input.byte() % std::size(kWords<OperatorKind>));
    command.gait = 0;
    command.joint = 0;
    if (change(input, command)) planner_.submit(command);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) cycle();
  }
  /// Contact of each leg by a bit, safety, whether the drives are on.
  void set_world(Input& input) {
    const std::uint8_t bits = input.byte();
    for (std::size_t i = 0; i < state_.legs.size(); ++i) state_.legs[i].contact = (bits >> (i % 4) & 1U) != 0;
    state_.safety = (bits & 0x10U) != 0 ? SafetyLevel::kDamping : SafetyLevel::kOperational;
    for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = (bits & 0x20U) == 0;
  }
  void change_state(Input& input) {
    JointState changed = state_;
    if (!change(input, changed)) return;
    changed.stamp.seq = state_.stamp.seq;
    state_ = changed;
    honest_ = false;
  }

 private:
  void cycle() {
    state_.stamp.utime_us += static_cast<std::int64_t>(1e6 * robot_.cycle_s);
    ++state_.stamp.seq;
    planner_.step(state_, legs_, motion_);
    for (OperatorReply reply; planner_.next_reply(reply);)
      require(reply.reason != nullptr, "a reason or none");
    if (honest_) require_finite();
    follow();
  }
  void require_finite() const {
    for (const DesiredLeg& leg : legs_.legs) {
      const bool foot = leg.control_mode == ControlMode::kPosition ||
                        leg.control_mode == ControlMode::kCompliance;
      if (foot)
        require(finite(leg.desired_foot_in_hip_m) && finite(leg.desired_foot_velocity_m_s), "a place to go");
      if (foot)
        require(finite(leg.desired_foot_acceleration_m_s2) && finite(leg.feedforward_force_N), "finite");
      if (leg.control_mode == ControlMode::kCompliance)
        require(finite(leg.stiffness_N_m) && finite(leg.damping_N_s_m), "a spring");
      if (leg.control_mode != ControlMode::kJoint) continue;
      for (std::size_t j = 0; j < robot_.legs[0].joints.size() && j < 3; ++j)
        require(std::isfinite(leg.desired_joint_position_rad[j]), "an angle to go to");
    }
  }
  void follow() {
    for (std::size_t i = 0; i < state_.legs.size(); ++i) {
      if (finite(legs_.legs[i].desired_foot_in_hip_m))
        state_.legs[i].estimated_foot_in_hip_m = legs_.legs[i].desired_foot_in_hip_m;
    }
  }

  const RobotConfig& robot_;
  double stand_m_;
  PlannerCore planner_;
  JointState state_;
  LegCommand legs_;
  MotionState motion_;
  std::int64_t last_id_ = 0;
  bool honest_ = true;  ///< no state that an estimator would not give
};

std::string request(OperatorKind kind) {
  return Output().byte(0).byte(static_cast<int>(kind)).byte(0).bytes();
}
std::string wait(int cycles) { return Output().byte(1).byte(cycles).bytes(); }

std::vector<std::string> request_seeds() {
  std::vector<std::string> seeds;
  for (const int robot : {0, 1}) {
    const std::string stand = Output().byte(robot).byte(0).bytes() + request(OperatorKind::kStand) +
                              wait(250) + wait(250);
    for (const auto kind :
         {OperatorKind::kJump, OperatorKind::kWalk, OperatorKind::kComply, OperatorKind::kSit,
          OperatorKind::kLand, OperatorKind::kMoveJoint, OperatorKind::kHold, OperatorKind::kEnable})
      seeds.push_back(stand + request(kind) + wait(200) + request(OperatorKind::kStop) + wait(100));
    seeds.push_back(stand + Output().byte(2).byte(0x10).bytes() + wait(10) +
                    Output().byte(3).byte(1).byte(0).number(std::uint16_t{40}).byte(0).bytes() + wait(5));
  }
  return seeds;
}

}  // namespace

/// Robot, preset, then requests, cycles, contacts and states.
SPRUNG_FUZZ(planner_requests, request_seeds) {
  const RobotConfig& robot = robots()[input.byte() % robots().size()];
  Bench bench(robot, robot.presets[input.byte() % robot.presets.size()]);
  for (int left = 40; left > 0 && !input.done(); --left) {
    switch (input.byte() % 4) {
      case 0:
        bench.submit(input);
        break;
      case 1:
        bench.run(input.byte());
        break;
      case 2:
        bench.set_world(input);
        break;
      default:
        bench.change_state(input);
    }
  }
}

}  // namespace sprung::fuzz::planner_requests
