#include "robots/known_weight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(KnownWeight, LoadsAJointWithAFifthOfItsTorqueAtMostInHalfKilograms) {
  for (const char* name : {"single_leg", "pegasus", "fennec", "test_axis"}) {
    const RobotConfig robot = load_robot(name);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const double weight_kg = known_weight_kg(robot, static_cast<int>(j));
      EXPECT_GE(weight_kg, 0.5) << name;
      EXPECT_EQ(std::round(2.0 * weight_kg), 2.0 * weight_kg) << name;
    }
  }
  RobotConfig leg = load_robot("single_leg");
  for (LinkConfig& link : leg.legs[0].links) link.length_m = 0.5;
  leg.actuators[1].torque_limit_Nm = 100.0;
  EXPECT_EQ(known_weight_kg(leg, 1), 2.0) << "20 Nm at a metre: 2.04 kg";
}

TEST(KnownWeight, AJointOfNoLegBearsNone) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs.clear();
  EXPECT_EQ(known_weight_kg(robot, 0), 0.0);
}

}  // namespace
}  // namespace sprung
