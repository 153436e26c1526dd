/// What healthy robots ask of the watch for impacts (drivers/bridge/impact_watch.h), and a leg that a wrong
/// direction in robot.yaml throws into its stop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"
#include "tests/simulation/in_process/seeds.h"

namespace sprung {
namespace {

using test::order_of;

constexpr double kSpan_s = 0.008;
constexpr double kWatched = 3.0;  ///< times its torque limit, in impact_watch.cpp

/// The largest change of a joint's true speed in 8 ms, in what its motor's torque limit gives motor and gear.
class HardestHit {
 public:
  explicit HardestHit(const RobotConfig& robot)
      : robot_(robot), cycles_(static_cast<std::size_t>(std::lround(kSpan_s / robot.cycle_s))) {}

  void look(const std::vector<TrueJoint>& joints) {
    before_.push_back(joints);
    if (before_.size() <= cycles_) return;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double change_rad_s = joints[j].true_velocity_rad_s - before_.front()[j].true_velocity_rad_s;
      const double most_rad_s = robot_.actuators[j].torque_limit_Nm / robot_.joints[j].armature_kg_m2 *
                                kSpan_s;
      times_ = std::max(times_, std::abs(change_rad_s) / most_rad_s);
    }
    before_.pop_front();
  }
  double times() const noexcept { return times_; }

 private:
  const RobotConfig& robot_;
  std::size_t cycles_;
  std::deque<std::vector<TrueJoint>> before_;
  double times_ = 0.0;
};

double hardest_of(InProcessRobot& robot, const RobotConfig& config, double seconds, const char* what) {
  HardestHit hit(config);
  for (double t_s = 0.0; t_s < seconds; t_s += config.cycle_s) {
    robot.tick();
    hit.look(robot.truth().joints);
  }
  std::printf("%s: at most %.2f times the torque limit\n", what, hit.times());
  return hit.times();
}

TEST(ImpactInMotion, HealthyJumpsAndGaitsStayBelowHalfOfWhatIsWatched) {
  const RobotConfig leg = load_robot("single_leg");
  InProcessRobot jumper(leg, "best", SimOptions{});
  test::stand_up(jumper, false);
  OperatorCommand jump = order_of(OperatorKind::kJump, 3);
  jump.jump_count = 3;
  jumper.submit(jump);
  EXPECT_LT(hardest_of(jumper, leg, 8.0, "three jumps"), 0.5 * kWatched);
  const RobotConfig quadruped = load_robot("pegasus");
  InProcessRobot walker(quadruped, "best", SimOptions{});
  test::stand_up(walker, true);
  walker.submit(test::walk_order(3, 0.3, 3));
  EXPECT_LT(hardest_of(walker, quadruped, 5.0, "a trot"), 0.5 * kWatched);
}

TEST(ImpactInMotion, LegOfAWrongDirectionIsStoppedAtItsStopAndGetsNoPowerAgain) {
  const RobotConfig machine = load_robot("single_leg");
  RobotConfig stack = machine;
  stack.actuators[0].direction *= -1;
  InProcessRobot robot(stack, "best", machine, SimOptions{});
  robot.boot();
  robot.submit(order_of(OperatorKind::kStand, 1));
  double beyond_s = 0.0;  // its limits by 50 mrad, while nothing is named
  for (int i = 0; i < 5000 && !robot.bridge().safety().latched; ++i) {
    robot.tick();
    const bool beyond = robot.truth().joints[0].true_position_rad < machine.joints[0].position_min_rad - 0.05;
    if (beyond) beyond_s += machine.cycle_s;
  }
  EXPECT_EQ(robot.bridge().safety().cause, SafetyCause::kImplausible);
  EXPECT_THAT(robot.bridge().safety().detail.data(), testing::HasSubstr("hip_motor: hit something"));
  EXPECT_LE(beyond_s, 0.05);
  for (int i = 0; i < 6000; ++i) robot.tick();
  robot.submit(order_of(OperatorKind::kClear, 2));
  for (int i = 0; i < 1000; ++i) robot.tick();
  robot.submit(order_of(OperatorKind::kStand, 3));
  for (int i = 0; i < 1000; ++i) {
    robot.tick();
    ASSERT_EQ(robot.sim().true_motor_torque_Nm(0), 0.0);
  }
}

}  // namespace
}  // namespace sprung
