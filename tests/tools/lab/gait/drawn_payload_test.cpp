#include "tools/lab/gait/drawn_payload.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(DrawnPayload, LiesAnywhereBetweenTheHipsOfThatRobot) {
  for (const char* name : {"pegasus", "fennec"}) {
    const RobotConfig robot = load_robot(name);
    const Vec3& hip_m = robot.legs.front().hip_in_trunk_m;
    Dice dice(1);
    std::set<double> x_m, y_m;
    for (int i = 0; i < 50; ++i) {
      const auto plant = drawn_payload(robot, 3.0, dice);
      EXPECT_EQ(plant.at("payload"), 3.0);
      x_m.insert(plant.at("payload_x") / std::abs(hip_m[0]));
      y_m.insert(plant.at("payload_y") / std::abs(hip_m[1]));
    }
    EXPECT_EQ(x_m.size(), 50u);
    for (const std::set<double>& share : {x_m, y_m}) {
      EXPECT_GE(*share.begin(), -1.0) << name;
      EXPECT_LE(*share.rbegin(), 1.0) << name;
      EXPECT_GT(*share.rbegin() - *share.begin(), 1.6) << name;
    }
  }
}

TEST(DrawnPayload, TheSameDiceGiveTheSame) {
  const RobotConfig robot = load_robot("pegasus");
  Dice one(7), again(7), other(8);
  EXPECT_EQ(drawn_payload(robot, 1.0, one), drawn_payload(robot, 1.0, again));
  EXPECT_NE(drawn_payload(robot, 1.0, one), drawn_payload(robot, 1.0, other));
}

}  // namespace
}  // namespace sprung
