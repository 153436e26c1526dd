#include "model/transmission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

LegConfig belt_leg() {
  LegConfig leg = load_robot("single_leg").legs[0];
  leg.transmission = {1.0, 0.0, 0.01, -1.0};  // errata E15, and a knee motor the other way round
  return leg;
}

JointVector pair(double a, double b) {
  JointVector v(2);
  v << a, b;
  return v;
}

TEST(TransmissionTest, PositionsGoThereAndBack) {
  const Transmission transmission(belt_leg());
  const JointVector joint = transmission.joint_from_actuator(pair(0.5, 1.0));
  EXPECT_DOUBLE_EQ(joint[0], 0.5);
  EXPECT_DOUBLE_EQ(joint[1], 0.005 - 1.0);
  EXPECT_LT((transmission.actuator_from_joint(joint) - pair(0.5, 1.0)).norm(), 1e-15);
}

TEST(TransmissionTest, PowerIsTheSameOnBothSides) {
  const Transmission transmission(belt_leg());
  const JointVector speed = pair(2.0, -3.0);
  const JointVector torque = pair(40.0, 70.0);
  EXPECT_NEAR(torque.dot(speed),
              transmission.joint_torque(torque).dot(transmission.joint_from_actuator(speed)), 1e-12);
  EXPECT_LT((transmission.actuator_torque(transmission.joint_torque(torque)) - torque).norm(), 1e-12);
}

TEST(TransmissionTest, BoundsAreNeverNegative) {
  const JointVector bound = Transmission(belt_leg()).joint_torque_bound(pair(1.0, 2.0));
  EXPECT_DOUBLE_EQ(bound[0], 1.0 + 0.01 * 2.0);
  EXPECT_DOUBLE_EQ(bound[1], 2.0);
}

TEST(TransmissionTest, MotionBoundsAddUpWhereMotionsCancel) {
  LegConfig leg = belt_leg();
  leg.transmission = {1.0, 0.0, -1.0, 1.0};
  const JointVector bound = Transmission(leg).joint_motion_bound(pair(0.5, 0.25));
  EXPECT_DOUBLE_EQ(bound[0], 0.5);
  EXPECT_DOUBLE_EQ(bound[1], 0.75);
}

TEST(TransmissionTest, KnowsWhichDriveMovesWhichJoint) {
  LegConfig leg = belt_leg();
  EXPECT_TRUE(Transmission(leg).couples(1, 0));
  EXPECT_FALSE(Transmission(leg).direct());
  leg.transmission = {1.0, 0.0, 0.0, 1.0};
  EXPECT_TRUE(Transmission(leg).direct());
  EXPECT_FALSE(Transmission(leg).couples(1, 0));
  EXPECT_TRUE(Transmission(leg).couples(1, 1));
}

TEST(TransmissionTest, OneJointIsMovedByTheDrivesThatItIsCoupledToAndReadsNoOther) {
  LegConfig leg = belt_leg();
  EXPECT_DOUBLE_EQ(Transmission(leg).joint_from_coupled(1, pair(0.5, 1.0)), 0.005 - 1.0);
  leg.transmission = {1.0, 0.0, 0.0, 1.0};
  EXPECT_EQ(Transmission(leg).joint_from_coupled(1, pair(kNaN, 0.3)), 0.3);
  EXPECT_TRUE(std::isnan(Transmission(leg).joint_from_coupled(0, pair(kNaN, 0.3))));
}

TEST(TransmissionTest, SingularOrMisshapenIsRefused) {
  LegConfig leg = belt_leg();
  leg.transmission = {1.0, 1.0, 1.0, 1.0};
  EXPECT_THROW(Transmission{leg}, std::invalid_argument);
  leg.transmission = {1.0, 0.0, 1.0};
  EXPECT_THROW(Transmission{leg}, std::invalid_argument);
}

}  // namespace
}  // namespace sprung
