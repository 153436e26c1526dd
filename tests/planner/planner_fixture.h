#pragma once
/// A planner whose joint state the test writes: drives enabled, safe, foot where the planner wants it unless
/// told otherwise.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/planner_core.h"
#include "robots/robot_loader.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/vec3.h"

namespace sprung {

class PlannerFixture : public testing::Test {
 protected:
  explicit PlannerFixture(RobotConfig robot = load_robot("single_leg")) : robot_(std::move(robot)) {
    state_.safety = SafetyLevel::kOperational;
    state_.stamp = {0, 0};
    for (EstimatedJoint& joint : state_.joints) {
      joint.status = JointStatus::kOk;
      joint.drive_enabled = true;
    }
    set_foot({0.02, 0.0, -0.30});
  }
  void set_foot(const Vec3& foot) { state_.legs[0].estimated_foot_in_hip_m = foot; }
  void set_enabled(bool enabled) {
    for (EstimatedJoint& joint : state_.joints) joint.drive_enabled = enabled;
  }
  void set_contact(bool contact) { state_.legs[0].contact = contact; }

  void cycle() {
    state_.stamp.utime_us += 1000;
    ++state_.stamp.seq;
    planner_.step(state_, leg_, motion_);
    for (OperatorReply r; planner_.next_reply(r);) replies_.push_back(r);
  }
  void run(double seconds) {
    for (int k = 0; k < static_cast<int>(seconds * 1000.0 + 0.5); ++k) cycle();
  }
  /// Cycles until the state is reached. @return seconds it took; fails after five.
  double run_until(MotionPhase wanted) {
    for (int k = 0; k < 5000; ++k) {
      if (motion_.state == wanted) return 1e-3 * k;
      cycle();
    }
    ADD_FAILURE() << "still " << name(motion_.state) << " instead of " << name(wanted);
    return 5.0;
  }

  std::int64_t send(OperatorCommand command) {
    command.request_id = ++last_id_;
    EXPECT_TRUE(planner_.submit(command));
    return last_id_;
  }
  std::int64_t send(OperatorKind kind) {
    OperatorCommand command;
    command.kind = kind;
    return send(command);
  }
  std::int64_t send_jump(JumpMode mode, int count = 1, double height_m = 0.0) {
    OperatorCommand command;
    command.kind = OperatorKind::kJump;
    command.jump_mode = mode;
    command.jump_count = count;
    command.jump_height_m = height_m;
    return send(command);
  }
  /// All outcomes that a request was answered with, in order, e.g. "accepted done".
  std::string outcomes(std::int64_t id) const {
    std::string out;
    for (const OperatorReply& r : replies_) {
      if (r.request_id == id) out += (out.empty() ? "" : " ") + std::string(name(r.outcome));
    }
    return out;
  }
  std::string last_reason(std::int64_t id) const {
    std::string out;
    for (const OperatorReply& r : replies_) {
      if (r.request_id == id) out = r.reason;
    }
    return out;
  }
  void stand_up() {
    send(OperatorKind::kStand);
    run_until(MotionPhase::kStanding);
    set_foot({0.0, 0.0, -preset_.stand_length_m});
    set_contact(true);
  }
  void jump_to(MotionPhase phase, JumpMode mode = JumpMode::kHybrid, int count = 1) {
    jump_id_ = send_jump(mode, count);
    run_until(MotionPhase::kThrust);
    if (phase == MotionPhase::kThrust) return;
    run(0.12);
    set_contact(false);
    run_until(MotionPhase::kFlight);
    if (phase == MotionPhase::kFlight) return;
    run(0.4);
    set_contact(true);
    run_until(phase);
  }
  const DesiredLeg& desired() const { return leg_.legs[0]; }

  RobotConfig robot_;
  PresetConfig preset_ = robot_.preset("paper");
  PlannerCore planner_{robot_, preset_};
  JointState state_{2, 1};
  LegCommand leg_{1};
  MotionState motion_{1};
  std::vector<OperatorReply> replies_;
  std::int64_t last_id_ = 0;
  std::int64_t jump_id_ = 0;
};

}  // namespace sprung
