#include "planner/gait/expected_ground.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr double kGroundStep_s = 0.002;
using Feet = std::array<GroundFoot, kMostLegs>;

Feet standing(double z_m) { return {{{z_m, true}, {z_m, true}, {z_m, true}, {z_m, true}}}; }

class ExpectedGroundTest : public testing::Test {
 protected:
  ExpectedGroundTest() {
    ground_.begin(-0.5);
    ground_.follow(standing(-0.5), kGroundStep_s);
  }
  ExpectedGround ground_;
};

TEST_F(ExpectedGroundTest, TrunkThatSinksIsFollowedAtOnce) {
  ground_.follow(standing(-0.49), kGroundStep_s);
  EXPECT_NEAR(ground_.z_m(), -0.49, 1e-12);
  EXPECT_NEAR(ground_.sunk_m(), 0.01, 1e-12);
  ground_.follow(standing(-0.49), kGroundStep_s);
  EXPECT_NEAR(ground_.sunk_m(), 0.0, 1e-12);
}

TEST_F(ExpectedGroundTest, FootThatLandsOnOtherGroundTeachesItSlowly) {
  Feet feet = standing(-0.5);
  feet[2].stands = false;
  ground_.follow(feet, kGroundStep_s);
  feet[2] = {-0.46, true};
  ground_.follow(feet, kGroundStep_s);
  EXPECT_EQ(ground_.sunk_m(), 0.0);
  EXPECT_NEAR(ground_.z_m(), -0.5 + 0.1 * kGroundStep_s, 1e-12);
  for (int k = 0; k < 100; ++k) ground_.follow(feet, kGroundStep_s);
  EXPECT_NEAR(ground_.z_m(), -0.49, 1e-12);
}

TEST_F(ExpectedGroundTest, FeetInTheAirSayNothing) {
  Feet feet = standing(-0.5);
  feet[0] = {-0.3, false};
  ground_.follow(feet, kGroundStep_s);
  feet[0].z_m = -0.4;
  ground_.follow(feet, kGroundStep_s);
  EXPECT_NEAR(ground_.z_m(), -0.5, 1e-12);
  for (GroundFoot& foot : feet) foot.stands = false;
  ground_.follow(feet, kGroundStep_s);
  EXPECT_NEAR(ground_.z_m(), -0.5, 1e-12);
  EXPECT_EQ(ground_.sunk_m(), 0.0);
}

TEST_F(ExpectedGroundTest, BeginsAnewWithoutWhatWasBefore) {
  ground_.begin(-0.3);
  ground_.follow(standing(-0.3), kGroundStep_s);
  EXPECT_NEAR(ground_.z_m(), -0.3, 1e-12);
  EXPECT_EQ(ground_.sunk_m(), 0.0);
}

}  // namespace
}  // namespace sprung
