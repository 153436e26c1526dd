#pragma once
/// What an operator says to a robot in this process, and until when.
#include <gtest/gtest.h>

#include "signals/operator.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung::test {

inline OperatorCommand order_of(OperatorKind kind, std::int64_t request_id) {
  OperatorCommand order;
  order.kind = kind;
  order.request_id = request_id;
  return order;
}

/// Ticks until the planner is in this phase; fails after so many cycles.
inline void tick_until(InProcessRobot& robot, MotionPhase phase, int cycles = 10000) {
  for (int i = 0; i < cycles && robot.motion_state().state != phase; ++i) robot.tick();
  ASSERT_EQ(robot.motion_state().state, phase) << robot.bridge().safety().detail.data();
}

/// A fault of an actuator's drive, from now on for so long.
inline void make_fault(InProcessRobot& robot, int actuator, FaultKind kind, double value, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.fault = kind;
  control.value = value;
  control.actuator = actuator;
  control.duration_s = duration_s;
  robot.sim().control(control);
}

/// From boot to a stand; of a robot with link encoders, by homing first.
inline void stand_up(InProcessRobot& robot, bool home) {
  robot.boot();
  if (home) {
    for (int i = 0; i < 1000; ++i) robot.tick();  // until it lies still
    OperatorCommand order = order_of(OperatorKind::kHome, 1);
    order.reference_source = ReferenceSource::kLink;
    robot.submit(order);
    for (int i = 0; i < 500; ++i) robot.tick();
  }
  robot.submit(order_of(OperatorKind::kStand, 2));
  tick_until(robot, MotionPhase::kStanding);
}

/// A walk forward, with a hold or (NaN) until told.
inline OperatorCommand walk_order(int gait, double speed_m_s, std::int64_t request_id, double hold_s = kNaN) {
  OperatorCommand order = order_of(OperatorKind::kWalk, request_id);
  order.gait = gait;
  order.walk_speed = {speed_m_s, 0.0, 0.0};
  order.hold_s = hold_s;
  return order;
}

}  // namespace sprung::test
