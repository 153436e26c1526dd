/// Ripple and presliding in the plant, whatever carries the gear's friction: a joint, a rotor, a linkage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

constexpr double kDry_Nm = 5.0;
constexpr double kWay_rad = 0.3e-3;

/// The bench with dry friction alone, to which a test adds.
class DryAxis : public testing::Test {
 protected:
  DryAxis() {
    friction().coulomb_Nm = friction().breakaway_Nm = kDry_Nm;
    config_.plant.joints[0].thermal = {};
  }
  FrictionConfig& friction() {
    if (!cleared_) config_.plant.joints[0].friction = {};
    cleared_ = true;
    return config_.plant.joints[0].friction;
  }
  Plant make() { return Plant(robot_, config_.plant); }
  /// From rest up to `last_Nm` in 0.2 s, then `seconds` with it.
  void push(Plant& plant, double last_Nm, double seconds) {
    for (int i = 0; i < 800; ++i) plant.step({last_Nm * i / 800});
    for (long i = std::lround(seconds / plant.step_s()); i > 0; --i) plant.step({last_Nm});
    ASSERT_FALSE(plant.failed()) << plant.failure();
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/test_axis");
  SimConfig config_ = load_sim_config(robot_, {});
  bool cleared_ = false;
};

TEST_F(DryAxis, NinetyPercentOfBreakawayHoldsForTenSecondsElastically) {
  friction().presliding_rad = kWay_rad;
  Plant plant = make();
  push(plant, 0.9 * kDry_Nm, 2.0);
  const double held_rad = plant.position_rad(0);
  EXPECT_GT(held_rad, 0.3 * kWay_rad) << "it gives way";
  EXPECT_LT(held_rad, kWay_rad);
  for (int i = 0; i < 40000; ++i) plant.step({0.9 * kDry_Nm});
  EXPECT_NEAR(plant.position_rad(0), held_rad, 1e-9) << "drift in 10 s";
  EXPECT_NEAR(plant.friction_torque_Nm(0) + plant.load_Nm(0), 0.9 * kDry_Nm, 1e-6);
}

TEST_F(DryAxis, BreaksLooseBeyondAndSlidesWithAllOfIt) {
  friction().presliding_rad = kWay_rad;
  Plant plant = make();
  push(plant, 1.2 * kDry_Nm, 0.5);
  EXPECT_GT(plant.position_rad(0), 20 * kWay_rad);
  EXPECT_NEAR(plant.friction_torque_Nm(0), kDry_Nm, 0.01);
}

/// Both laws once all slides: the same motion but for the first way.
TEST_F(DryAxis, PreslidingOnlyShowsWhereMotionBegins) {
  Plant rigid = make();
  friction().presliding_rad = kWay_rad;
  Plant elastic = make();
  for (int i = 0; i < 2000; ++i) {
    const double pushed_Nm = 20.0 * std::sin(2 * M_PI * i / 2000.0);
    rigid.step({pushed_Nm});
    elastic.step({pushed_Nm});
  }
  EXPECT_GT(std::abs(rigid.position_rad(0)), 0.1);
  EXPECT_NEAR(elastic.position_rad(0), rigid.position_rad(0), 0.01);
}

TEST_F(DryAxis, RotorOfATwistingGearIsHeldElasticallyToo) {
  config_.plant.joints[0].torsion = TorsionConfig{2.5e4, 2.5e4, 0.0, 5.0};
  friction().presliding_rad = kWay_rad;
  Plant plant = make();
  push(plant, 0.9 * kDry_Nm, 2.0);
  const double rest_rad = plant.motor_position_rad(0);
  EXPECT_GT(rest_rad, 0.3 * kWay_rad);
  EXPECT_LT(rest_rad, kWay_rad);
  for (int i = 0; i < 40000; ++i) plant.step({0.9 * kDry_Nm});
  EXPECT_NEAR(plant.motor_position_rad(0), rest_rad, 1e-9);
  EXPECT_NEAR(plant.friction_torque_Nm(0) + plant.load_Nm(0), 0.9 * kDry_Nm, 1e-6);
}

/// At each angle the torque that is missing in the balance is what the law says.
TEST_F(DryAxis, FrictionRipplesWithTheMotorsAngle) {
  friction().motor_ripple = {0.2, 2.0, 0.5};
  Plant plant = make();
  const double ratio = robot_.actuators[0].gear_ratio;
  double least_Nm = 1e9, most_Nm = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double angle_rad = plant.position_rad(0);
    plant.step({60.0 * (0.1 - plant.velocity_rad_s(0)) + kDry_Nm + plant.load_Nm(0)});
    if (i < 2000) continue;
    const double expected_Nm = kDry_Nm * (1.0 + 0.2 * std::sin(2.0 * ratio * angle_rad + 0.5));
    ASSERT_NEAR(plant.friction_torque_Nm(0), expected_Nm, 0.02) << angle_rad;
    least_Nm = std::min(least_Nm, plant.friction_torque_Nm(0));
    most_Nm = std::max(most_Nm, plant.friction_torque_Nm(0));
  }
  EXPECT_NEAR(least_Nm, 0.8 * kDry_Nm, 0.05);
  EXPECT_NEAR(most_Nm, 1.2 * kDry_Nm, 0.05);
}

TEST_F(DryAxis, FrictionThatIsTooStiffForTheStepIsRefused) {
  friction().presliding_rad = 1e-6;
  const std::string refusal = test::refusal_of<ConfigError>([&] { make(); });
  EXPECT_THAT(refusal, testing::HasSubstr("arm: friction that slides after"));
  EXPECT_THAT(refusal, testing::HasSubstr("make `presliding` longer"));
}

TEST_F(DryAxis, AnotherLifeIsTheSameToTheLastBit) {
  friction().presliding_rad = kWay_rad;
  Plant plant = make();
  const auto life = [&] {
    push(plant, 30.0, 0.1);
    return plant.position_rad(0);
  };
  const double first_rad = life();
  plant.reset();
  EXPECT_EQ(life(), first_rad);
}

/// Knees that turn with their hips, as linkage_test.cpp has them: the friction of a linkage's gear holds the
/// motor's speed.
TEST(ElasticLinkage, HangingLegComesToRestAndStays) {
  RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  for (LegConfig& leg : robot.legs) leg.transmission = {1, 0, 0, 0, 1, 0, 0, 1, 1};
  SimConfig config = load_sim_config(robot, {{"suspended", 0.8}});
  for (PlantJointConfig& joint : config.plant.joints) joint.friction.presliding_rad = kWay_rad;
  Plant plant(robot, config.plant);
  const std::vector<double> none(robot.joints.size(), 0.0);
  for (int i = 0; i < 8000; ++i) plant.step(none);
  std::vector<double> rest_rad;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) rest_rad.push_back(plant.position_rad(i));
  for (int i = 0; i < 4000; ++i) plant.step(none);
  ASSERT_FALSE(plant.failed()) << plant.failure();
  for (std::size_t i = 0; i < robot.joints.size(); ++i)
    EXPECT_NEAR(plant.position_rad(i), rest_rad[i], 1e-7) << robot.joints[i].name;
}

}  // namespace
}  // namespace sprung::sim
