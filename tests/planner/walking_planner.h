#pragma once
/// The planner of pegasus, its feet where they are wanted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "planner/planner_core.h"
#include "robots/robot_loader.h"

namespace sprung {

class WalkingPlanner : public testing::Test {
 protected:
  WalkingPlanner() {
    state_.safety = SafetyLevel::kOperational;
    for (EstimatedJoint& joint : state_.joints) {
      joint.status = JointStatus::kOk;
      joint.drive_enabled = true;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      state_.legs[i].estimated_foot_in_hip_m = {0.0, i % 2 == 0 ? 0.08 : -0.08, -0.24};
      state_.legs[i].contact = true;
    }
    tilt(0.0);
    state_.body.estimated_height_m = 0.24;
    state_.body.uses_imu = true;
  }
  void tilt(double roll_rad) {
    state_.body.estimated_quaternion_wxyz = {std::cos(0.5 * roll_rad), std::sin(0.5 * roll_rad), 0.0, 0.0};
  }
  void cycle() {
    state_.stamp.utime_us += 2000;
    ++state_.stamp.seq;
    planner_.step(state_, legs_, motion_);
    for (OperatorReply r; planner_.next_reply(r);) replies_.push_back(r);
    if (motion_.state == MotionPhase::kIdle || motion_.state == MotionPhase::kFallen) return;
    for (std::size_t i = 0; i < 4; ++i) {
      Vec3 foot = legs_.legs[i].desired_foot_in_hip_m;
      const double floor_m = motion_.state == MotionPhase::kWalking && i == hole_
                                 ? -1.0
                                 : -robot_.preset("best").stand_length_m;
      state_.legs[i].contact = foot[2] <= floor_m + 1e-9 || motion_.state != MotionPhase::kWalking;
      foot[2] = std::max(foot[2], floor_m);
      state_.legs[i].estimated_foot_in_hip_m = foot;
    }
    state_.body.estimated_height_m = -state_.legs[0].estimated_foot_in_hip_m[2];
  }
  void run(double seconds) {
    for (int k = 0; k < static_cast<int>(seconds / 0.002 + 0.5); ++k) cycle();
  }
  void run_until(MotionPhase wanted) {
    for (int k = 0; k < 10000 && motion_.state != wanted; ++k) cycle();
    EXPECT_EQ(motion_.state, wanted) << motion_.last_transition;
  }
  OperatorReply send(OperatorCommand command) {
    command.request_id = ++last_id_;
    EXPECT_TRUE(planner_.submit(command));
    cycle();
    return answer(last_id_);
  }
  OperatorReply send(OperatorKind kind) {
    OperatorCommand command;
    command.kind = kind;
    return send(command);
  }
  OperatorReply walk(int gait, const Vec3& speed = {0.0, 0.0, 0.0}) {
    OperatorCommand command;
    command.kind = OperatorKind::kWalk;
    command.gait = gait;
    command.walk_speed = speed;
    return send(command);
  }
  /// The last one.
  OperatorReply answer(std::int64_t id) const {
    OperatorReply out;
    for (const OperatorReply& r : replies_)
      if (r.request_id == id) out = r;
    return out;
  }
  void stand_up() {
    if (motion_.state != MotionPhase::kStanding) send(OperatorKind::kStand);
    run_until(MotionPhase::kStanding);
  }
  bool every_leg(ControlMode mode) const {
    return std::all_of(legs_.legs.begin(), legs_.legs.end(),
                       [&](const DesiredLeg& l) { return l.control_mode == mode; });
  }

  static constexpr int kStand = 0, kCrawl = 1, kTrot = 3;
  const RobotConfig robot_ = load_robot("pegasus");
  PlannerCore planner_{robot_, robot_.preset("best")};
  JointState state_{12, 4};
  LegCommand legs_{4};
  MotionState motion_{4};
  std::vector<OperatorReply> replies_;
  std::int64_t last_id_ = 0;
  std::size_t hole_ = 99;
};

}  // namespace sprung
