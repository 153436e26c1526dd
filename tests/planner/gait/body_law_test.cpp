#include "planner/gait/body_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

class BodyLawTest : public testing::Test {
 protected:
  BodyWrench wrench() const { return wanted_wrench(law_, shape_, view_, wish_); }

  const RobotConfig robot_ = load_robot("pegasus");
  const WalkConfig law_ = [] {
    WalkConfig law;
    law.body_stiffness = {300.0, 400.0, 500.0};
    law.body_damping = {30.0, 40.0, 50.0};
    law.speed_damping = {100.0, 80.0};
    return law;
  }();
  const BodyShape shape_{robot_};
  BodyView view_;
  BodyWish wish_;
};

TEST_F(BodyLawTest, AtRestAndLevelItIsTheWeight) {
  view_.velocity_known = true;
  EXPECT_TRUE(wrench().force_N.isApprox(Eigen::Vector3d(0.0, 0.0, shape_.mass_kg * kGravity_m_s2), 1e-12));
  EXPECT_TRUE(wrench().torque_Nm.isZero());
}

TEST_F(BodyLawTest, HeightAndSpeedArePulledToWhatIsWished) {
  wish_.height_m = 0.50;
  wish_.height_now_m = 0.48;
  wish_.velocity_m_s = {0.3, 0.1, 0.0};
  view_.velocity_known = true;
  view_.velocity_m_s = {0.2, 0.2, -0.1};
  const Eigen::Vector3d force_N = wrench().force_N;
  EXPECT_NEAR(force_N.x(), 100.0 * 0.1, 1e-9);
  EXPECT_NEAR(force_N.y(), 80.0 * -0.1, 1e-9);
  EXPECT_NEAR(force_N.z() - shape_.mass_kg * kGravity_m_s2, 500.0 * 0.02 + 50.0 * 0.1, 1e-9);
}

TEST_F(BodyLawTest, TrunkThatLiesAsItIsWishedIsNotTurned) {
  wish_.attitude = attitude_along({0.2, 0.1});
  view_.attitude = wish_.attitude;
  EXPECT_TRUE(wrench().torque_Nm.isZero());
  view_.attitude = {};
  EXPECT_NEAR(wrench().torque_Nm.x(), 300.0 * wish_.attitude.roll_rad, 1e-9);
  EXPECT_NEAR(wrench().torque_Nm.y(), 400.0 * wish_.attitude.pitch_rad, 1e-9);
}

TEST_F(BodyLawTest, SpeedThatIsNotKnownIsNotDamped) {
  wish_.velocity_m_s = {0.3, 0.1, 0.0};
  view_.velocity_m_s = {5.0, 5.0, 5.0};
  EXPECT_NEAR(wrench().force_N.head<2>().norm(), 0.0, 1e-12);
}

TEST_F(BodyLawTest, TiltIsTurnedBackAndDampedWithTheSignsOfTheAxes) {
  view_.attitude = {0.1, -0.2, 1.0};
  view_.angular_velocity_rad_s = {0.5, 0.25, 3.0};
  EXPECT_TRUE(wrench().torque_Nm.isApprox(
      Eigen::Vector3d(-300.0 * 0.1 - 30.0 * 0.5, 400.0 * 0.2 - 40.0 * 0.25, 0.0), 1e-12));
}

TEST(LeanTest, DoesNineTenthsOfItsWayInItsTimeWithoutOvershoot) {
  Lean lean;
  const Eigen::Vector2d wanted_m(0.06, -0.03);
  Eigen::Vector2d before = lean.at_m();
  for (int k = 1; k <= 1000; ++k) {
    lean.follow(wanted_m, 0.5, 0.001);
    EXPECT_LE((wanted_m - lean.at_m()).norm(), (wanted_m - before).norm() + 1e-12);
    before = lean.at_m();
    if (k == 500) {
      EXPECT_NEAR(lean.at_m().norm() / wanted_m.norm(), 0.9, 0.01);
    }
  }
  EXPECT_NEAR((lean.at_m() - wanted_m).norm(), 0.0, 1e-3);
}

TEST(LeanTest, NeitherPlaceNorSpeedJumpsWhenItsAimDoes) {
  Lean lean;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector2d at = lean.at_m(), speed = lean.speed_m_s();
    lean.follow({(k / 300) % 2 == 0 ? 0.06 : -0.06, 0.02}, 0.8, 0.002);
    EXPECT_LT((lean.at_m() - at).norm(), 0.3 * 0.002);
    EXPECT_LT((lean.speed_m_s() - speed).norm(), 4.0 * 0.002);
    EXPECT_TRUE((lean.at_m() - at).isApprox(0.002 * lean.speed_m_s(), 1e-9));
  }
  lean.rest_at(Eigen::Vector2d::Zero());
  EXPECT_TRUE(lean.at_m().isZero() && lean.speed_m_s().isZero());
}

}  // namespace
}  // namespace sprung
