/// An encoder that sticks while its joint works hard (hazard 1: seen in a jump's thrust, where the knee ran
/// into its stop): how soon it is noticed, and how fast the joint gets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

using test::order_of;

struct Noticed {
  double after_s = -1.0;    ///< -1: never
  double peak_rad_s = 0.0;  ///< of any joint, from the fault on, as it truly was
  std::string detail;
};

class StuckEncoderInMotion : public testing::TestWithParam<std::uint64_t> {
 protected:
  /// Sticks the encoder now and looks for a second.
  static Noticed stick(InProcessRobot& robot, int actuator, double cycle_s) {
    SimControl fault;
    fault.kind = SimControlKind::kNodeFault;
    fault.fault = FaultKind::kEncoderStuck;
    fault.actuator = actuator;
    fault.duration_s = 10.0;
    robot.sim().control(fault);
    Noticed out;
    for (int i = 0; i < static_cast<int>(1.0 / cycle_s); ++i) {
      robot.tick();
      for (const TrueJoint& joint : robot.truth().joints)
        out.peak_rad_s = std::max(out.peak_rad_s, std::abs(joint.true_velocity_rad_s));
      if (out.after_s < 0.0 && robot.bridge().safety().level != SafetyLevel::kOperational) {
        out.after_s = i * cycle_s;
        out.detail = robot.bridge().safety().detail.data();
      }
    }
    return out;
  }
  /// Prints the figures of docs/measured.md.
  static void expect_noticed(const Noticed& noticed, const ActuatorConfig& drive, double within_s) {
    std::printf("%s: noticed after %.0f ms, fastest joint %.1f rad/s; %s\n", drive.name.c_str(),
                1e3 * noticed.after_s, noticed.peak_rad_s, noticed.detail.c_str());
    EXPECT_GE(noticed.after_s, 0.0) << drive.name;
    EXPECT_LE(noticed.after_s, within_s) << drive.name << ": " << noticed.detail;
    EXPECT_LE(noticed.peak_rad_s, 1.2 * drive.speed_limit_rad_s) << drive.name;
  }
};

TEST_P(StuckEncoderInMotion, OfAThrustIsNoticed) {
  const RobotConfig config = load_robot("single_leg");
  for (const int actuator : {0, 1}) {
    SimOptions sim;
    sim.seed = GetParam();
    InProcessRobot robot(config, "best", sim);
    robot.boot();
    robot.submit(order_of(OperatorKind::kStand, 1));
    while (robot.motion_state().state != MotionPhase::kStanding) ASSERT_TRUE(robot.tick());
    robot.submit(order_of(OperatorKind::kJump, 2));
    while (robot.motion_state().state != MotionPhase::kThrust) ASSERT_TRUE(robot.tick());
    for (std::uint64_t i = 0; i < 10 * (GetParam() % 5); ++i) robot.tick();  // somewhere in it
    expect_noticed(stick(robot, actuator, config.cycle_s), config.actuators[actuator], 0.050);
  }
}

TEST_P(StuckEncoderInMotion, OfATrotIsNoticed) {
  const RobotConfig config = load_robot("pegasus");
  for (const int actuator : {1, 2}) {
    SimOptions sim;
    sim.seed = GetParam();
    InProcessRobot robot(config, "best", sim);
    robot.boot();
    for (int i = 0; i < 1000; ++i) robot.tick();  // until it lies still
    OperatorCommand home = order_of(OperatorKind::kHome, 1);
    home.reference_source = ReferenceSource::kLink;
    robot.submit(home);
    for (int i = 0; i < 500; ++i) robot.tick();
    robot.submit(order_of(OperatorKind::kStand, 2));
    for (int i = 0; i < 5000 && robot.motion_state().state != MotionPhase::kStanding; ++i) robot.tick();
    ASSERT_EQ(robot.motion_state().state, MotionPhase::kStanding);
    OperatorCommand walk = order_of(OperatorKind::kWalk, 3);
    walk.gait = 3;
    walk.walk_speed = {0.3, 0.0, 0.0};
    robot.submit(walk);
    for (int i = 0; i < 1500 + 37 * static_cast<int>(GetParam()); ++i) robot.tick();
    ASSERT_EQ(robot.motion_state().state, MotionPhase::kWalking) << robot.bridge().safety().detail.data();
    // Under little torque it is the link encoder that notices, when the joint has moved.
    expect_noticed(stick(robot, actuator, config.cycle_s), config.actuators[actuator], 0.300);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, StuckEncoderInMotion, testing::Range<std::uint64_t>(1, 5));

}  // namespace
}  // namespace sprung
